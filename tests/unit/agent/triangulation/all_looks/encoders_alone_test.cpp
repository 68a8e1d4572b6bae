// Several looks without any background: what the encoders and the target say.
#include <Eigen/Core>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/triangulation/all_looks/locate.hpp"
#include "agent/triangulation/estimate.hpp"

#include "tests/unit/agent/triangulation/estimates.hpp"
#include "tests/unit/agent/triangulation/scenes.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::triangulation::all_looks::encoders_alone_test {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// The ends of the field on both axes, as a planner would choose them: 5 looks.
const std::vector<geometry::HeadAngles> moves{
    {0.0, 0.0}, {-0.35, 0.25}, {0.3, 0.3}, {-0.3, -0.2}, {0.35, -0.15}};

Scene scene_ahead() {
  Scene scene = step_rule_scene();
  scene.head_1 = {0.0, 0.1};
  scene.torso_point_m = {0.7, 0.0, 0.1};
  return scene;
}

std::vector<Look> exact_looks(const Scene& scene) {
  std::vector<Look> looks;
  for (const geometry::HeadAngles& move : moves) looks.push_back(scene.look(scene.head_1 + move));
  return looks;
}

geometry::Uncertainty calibrated() {
  return {.pixel_sigma_px = 0.3,
          .encoder_sigma_rad = 1e-3,
          .zero_sigma_rad = 3e-3,
          .focal_sigma_px = 2.0,
          .centre_sigma_px = 1.0,
          .mount_offset_sigma_m = 1e-3,
          .mount_rotation_sigma_rad = 3e-3};
}

geometry::Uncertainty only_noise() {
  return {.pixel_sigma_px = 0.3, .encoder_sigma_rad = 1e-3};
}

Estimate locate_without_features(const Scene& scene, const geometry::Uncertainty& uncertainty,
                                 const std::vector<Look>& looks) {
  return locate(scene.rig(uncertainty), looks, {}, Gate{});
}

/// Look 1's pixel defines the point: only the later ones are found with an error.
std::vector<Look> measured_looks(const Scene& scene, const geometry::Uncertainty& uncertainty,
                                 Random& random) {
  std::vector<Look> looks;
  for (const Look& look : exact_looks(scene)) {
    looks.push_back(measured_look(look, uncertainty, Eigen::Matrix2d::Zero(), random));
  }
  looks[0].pixel = exact_looks(scene)[0].pixel;
  return looks;
}

/// Of the weak prior of the inverse depth.
constexpr double prior_m = 1e-7;

TEST(AllLooksEncodersAlone, TwoLooksSayWhatTheirPairSays) {
  const Scene scene = scene_ahead();
  std::vector<Look> looks = exact_looks(scene);
  looks.resize(2);
  looks[1].pixel.x() += 0.4;
  looks[1].covariance_px2 = 0.1 * Eigen::Matrix2d::Identity();
  const TwoLooks pair{looks[0].head, looks[1].head, looks[0].pixel, looks[1].pixel,
                      looks[1].covariance_px2};
  const PointEstimate expected = estimate_point(scene.rig(calibrated()), pair, Gate{});
  const Estimate found = locate_without_features(scene, calibrated(), looks);
  EXPECT_EQ(found.looks_used, 2U);
  EXPECT_EQ(found.degrees_of_freedom, 1);
  EXPECT_EQ(found.point.status, expected.status);
  EXPECT_EQ(found.looks[1].inverse_range_per_m, expected.inverse_range_per_m);
  EXPECT_EQ(found.looks[1].inverse_range_sigma_per_m, expected.inverse_range_sigma_per_m);
  EXPECT_NEAR(found.point.inverse_range_per_m, expected.inverse_range_per_m,
              0.1 * expected.inverse_range_sigma_per_m);
  EXPECT_NEAR(found.point.inverse_range_sigma_per_m, expected.inverse_range_sigma_per_m,
              0.05 * expected.inverse_range_sigma_per_m);
}

TEST(AllLooksEncodersAlone, ExactLooksGiveTheExactPoint) {
  const Scene scene = scene_ahead();
  const Estimate found = locate_without_features(scene, calibrated(), exact_looks(scene));
  EXPECT_EQ(found.point.status, Status::located) << found.point.reason;
  expect_filled(found.point, Filled::position);
  EXPECT_LT((found.point.torso_point_m - scene.torso_point_m).norm(), prior_m);
  EXPECT_EQ(found.looks_used, 5U);
  EXPECT_EQ(found.degrees_of_freedom, 7);
  EXPECT_LT(found.chi2, 1e-9);
  EXPECT_THAT(found.point.reason, testing::Not(HasSubstr("left out")));
}

TEST(AllLooksEncodersAlone, MoreLooksAreSurerThanAnyPair) {
  const Scene scene = scene_ahead();
  const Estimate found = locate_without_features(scene, calibrated(), exact_looks(scene));
  for (std::size_t k = 1; k < moves.size(); ++k) {
    EXPECT_TRUE(found.looks[k].used);
    EXPECT_LT(found.point.inverse_range_sigma_per_m, found.looks[k].inverse_range_sigma_per_m);
  }
}

/// With n later looks that are all alike, only what each has of its own is averaged.
TEST(AllLooksEncodersAlone, TheFirstLooksNoiseIsNotAveragedAway) {
  const Scene scene = scene_ahead();
  const Look first = scene.look(scene.head_1), later = scene.look(scene.head_1 + moves[1]);
  const double one =
      locate_without_features(scene, only_noise(), {first, later}).point.inverse_range_sigma_per_m;
  const double two = locate_without_features(scene, only_noise(), {first, later, later})
                         .point.inverse_range_sigma_per_m;
  const double eight = locate_without_features(scene, only_noise(),
                                               std::vector<Look>{first, later, later, later, later,
                                                                 later, later, later, later})
                           .point.inverse_range_sigma_per_m;
  const double own_2 = 2.0 * (one * one - two * two);  // one = common + own, two = common + own/2
  const double common_2 = one * one - own_2;
  EXPECT_GT(common_2, 0.2 * one * one);
  // Of two image coordinates nearly all is in the one along the epipolar line.
  constexpr double second_coordinate = 1e-3;
  EXPECT_NEAR(eight * eight, common_2 + own_2 / 8.0, second_coordinate * one * one);
}

TEST(AllLooksEncodersAlone, CalibrationIsNotAveragedAway) {
  const Scene scene = scene_ahead();
  geometry::Uncertainty uncertainty = only_noise();
  const auto added_by = [&](const geometry::Uncertainty& calibration) {
    const double with = locate_without_features(scene, calibration, exact_looks(scene))
                            .point.inverse_range_sigma_per_m;
    const double without = locate_without_features(scene, uncertainty, exact_looks(scene))
                               .point.inverse_range_sigma_per_m;
    return std::sqrt(with * with - without * without) / scene.inverse_range_per_m();
  };
  geometry::Uncertainty arm = uncertainty, focal = uncertainty;
  arm.mount_offset_sigma_m = 1e-3;
  focal.focal_sigma_px = 2.0;
  // 1 mm of lever arm costs 1.7 % whatever the moves; 2 px of focal length at f 752 about
  // 2/752 (Z + L) / L with L = 58.71 cos p + 63.64 sin p mm, which is 65 mm for p = 0.1.
  EXPECT_NEAR(added_by(arm), 0.017, 0.003);
  EXPECT_NEAR(added_by(focal), 2.0 / 752.0 * (0.7 + 0.065) / 0.065, 0.008);
}

TEST(AllLooksEncodersAlone, ThePredictedSigmasAreThoseOfTheErrors) {
  constexpr double agreement = 0.1;
  constexpr int samples = test::trials(4000, 1000);
  const Scene scene = scene_ahead();
  for (const geometry::Uncertainty& uncertainty : {only_noise(), calibrated()}) {
    const PointEstimate predicted =
        locate_without_features(scene, uncertainty, exact_looks(scene)).point;
    Random random(51);
    double variance = 0.0, torso_variance = 0.0;
    int within = 0, contradicted = 0;
    for (int i = 0; i < samples; ++i) {
      const geometry::Rig rig = believed_rig(scene, uncertainty, random);
      const std::vector<Look> looks = measured_looks(scene, uncertainty, random);
      const Estimate found = locate(rig, looks, {}, open_gate);
      contradicted += found.looks_used < looks.size() ? 1 : 0;
      const double error = found.point.inverse_range_per_m - scene.inverse_range_per_m();
      variance += error * error / samples;
      torso_variance += (found.point.torso_point_m - scene.torso_point_m).squaredNorm() / samples;
      within += std::abs(error) <= found.point.inverse_range_sigma_per_m ? 1 : 0;
    }
    EXPECT_NEAR(std::sqrt(variance), predicted.inverse_range_sigma_per_m,
                agreement * predicted.inverse_range_sigma_per_m);
    const double torso_sigma = std::sqrt(predicted.torso_covariance_m2.trace());
    EXPECT_NEAR(std::sqrt(torso_variance), torso_sigma, agreement * torso_sigma);
    EXPECT_GE(within, 0.65 * samples);
    EXPECT_LE(within, 0.71 * samples);
    EXPECT_LE(contradicted, 0.004 * samples) << "99.9 % of chi-square";
  }
}

/// A look at a point behind the target, on the line through it from camera 1 and the later camera's
/// epipolar line: its own pair sees nothing wrong.
Look look_at_another_point(const Scene& scene, geometry::HeadAngles head) {
  Scene other = scene;
  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(scene.head, scene.head_1).inverse();
  const Vector3d ray = scene.torso_point_m - torso_from_cam1.translation;
  other.torso_point_m = torso_from_cam1.translation + 1.6 * ray;
  return other.look(head);
}

TEST(AllLooksEncodersAlone, ALookAtAnotherObjectIsDroppedAndNamed) {
  const Scene scene = scene_ahead();
  for (std::size_t wrong = 1; wrong < moves.size(); ++wrong) {
    std::vector<Look> looks = exact_looks(scene);
    looks[wrong] = look_at_another_point(scene, looks[wrong].head);
    const Estimate found = locate_without_features(scene, only_noise(), looks);
    EXPECT_EQ(found.point.status, Status::located) << found.point.reason;
    EXPECT_LT((found.point.torso_point_m - scene.torso_point_m).norm(), prior_m);
    EXPECT_EQ(found.looks_used, 4U);
    EXPECT_FALSE(found.looks[wrong].used);
    EXPECT_EQ(found.looks[wrong].status, Status::target_lost);
    EXPECT_GT(found.looks[wrong].chi2, 13.816);
    EXPECT_THAT(found.point.reason, HasSubstr("look " + std::to_string(wrong + 1) + " left out"));
  }
}

TEST(AllLooksEncodersAlone, TwoLooksThatContradictEachOtherAreNoPoint) {
  const Scene scene = scene_ahead();
  std::vector<Look> looks = exact_looks(scene);
  looks.resize(3);
  looks[2] = look_at_another_point(scene, looks[2].head);
  const Estimate found = locate_without_features(scene, only_noise(), looks);
  EXPECT_EQ(found.point.status, Status::target_lost);
  expect_filled(found.point, Filled::residual);
  EXPECT_EQ(found.looks_used, 0U);
  EXPECT_GT(found.chi2, 10.828);
  EXPECT_THAT(found.point.reason, HasSubstr("contradict each other"));
}

TEST(AllLooksEncodersAlone, ALookOffItsEpipolarLineIsLeftOut) {
  const Scene scene = scene_ahead();
  std::vector<Look> looks = exact_looks(scene);
  looks[3].pixel += geometry::Pixel(20.0, 30.0);
  const Estimate found = locate_without_features(scene, only_noise(), looks);
  EXPECT_EQ(found.point.status, Status::located) << found.point.reason;
  EXPECT_EQ(found.looks[3].status, Status::target_lost);
  EXPECT_THAT(found.point.reason, HasSubstr("look 4 left out: epipolar residual"));
  EXPECT_LT((found.point.torso_point_m - scene.torso_point_m).norm(), prior_m);
}

TEST(AllLooksEncodersAlone, ALookThatDidNotMoveDoesNoHarmAndOneThatIsNoneIsLeftOut) {
  const Scene scene = scene_ahead();
  std::vector<Look> looks = exact_looks(scene);
  looks[1] = looks[0];
  looks[2].pixel.x() = not_a_number;
  const Estimate found = locate_without_features(scene, calibrated(), looks);
  EXPECT_EQ(found.point.status, Status::located) << found.point.reason;
  EXPECT_EQ(found.looks[1].status, Status::degenerate);
  EXPECT_EQ(found.looks[2].status, Status::invalid_input);
  EXPECT_EQ(found.looks_used, 4U);
  EXPECT_FALSE(found.looks[2].used);
  EXPECT_LT((found.point.torso_point_m - scene.torso_point_m).norm(), prior_m);
  const Estimate without =
      locate_without_features(scene, calibrated(), {looks[0], looks[3], looks[4]});
  EXPECT_LE(found.point.inverse_range_sigma_per_m, without.point.inverse_range_sigma_per_m);
}

TEST(AllLooksEncodersAlone, NothingUsableSaysWhatTheBestPairFailedOf) {
  const Scene scene = scene_ahead();
  std::vector<Look> looks = exact_looks(scene);
  looks.resize(3);
  looks[1].pixel.x() = not_a_number;
  looks[2] = looks[0];
  Estimate found = locate_without_features(scene, calibrated(), looks);
  EXPECT_EQ(found.point.status, Status::degenerate);
  EXPECT_EQ(found.looks_used, 0U);
  looks[0].pixel.x() = not_a_number;
  found = locate_without_features(scene, calibrated(), looks);
  EXPECT_EQ(found.point.status, Status::invalid_input);
  expect_filled(found.point, Filled::nothing);
}

TEST(AllLooksEncodersAlone, WithoutAnySigmaItStillAnswers) {
  const Scene scene = scene_ahead();
  const Estimate found = locate_without_features(scene, {}, exact_looks(scene));
  EXPECT_EQ(found.point.status, Status::located) << found.point.reason;
  EXPECT_LT((found.point.torso_point_m - scene.torso_point_m).norm(), prior_m);
}

TEST(AllLooksEncodersAlone, FarLooksHaveNoBiasInInverseRange) {
  // At 20 m each pair may be anything, also behind: all together have no bias.
  constexpr int samples = test::trials(4000, 1000);
  Scene scene = scene_ahead();
  scene.torso_point_m = {20.0, 0.0, 0.1};
  Random random(52);
  double sum = 0.0, sum_2 = 0.0;
  int behind = 0;
  for (int i = 0; i < samples; ++i) {
    const Estimate found =
        locate_without_features(scene, only_noise(), measured_looks(scene, only_noise(), random));
    if (!std::isfinite(found.point.inverse_range_per_m)) continue;
    const double error = found.point.inverse_range_per_m - scene.inverse_range_per_m();
    sum += error / samples;
    sum_2 += error * error / samples;
    behind += found.looks[1].status == Status::behind_camera ? 1 : 0;
  }
  EXPECT_LT(std::abs(sum), 0.1 * std::sqrt(sum_2));
  EXPECT_GT(behind, 0) << "else the test is about nothing";
}

TEST(AllLooksEncodersAlone, SixteenLooksFitAndMoreOrFewerThanTwoAreRefused) {
  const Scene scene = scene_ahead();
  std::vector<Look> looks{scene.look(scene.head_1)};
  EXPECT_THROW(static_cast<void>(locate_without_features(scene, calibrated(), looks)),
               std::invalid_argument);
  while (looks.size() < looks_max) looks.push_back(scene.look(scene.head_1 + moves[1]));
  EXPECT_EQ(locate_without_features(scene, calibrated(), looks).looks_used, looks_max);
  looks.push_back(looks.back());
  EXPECT_THROW(static_cast<void>(locate_without_features(scene, calibrated(), looks)),
               std::invalid_argument);
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::encoders_alone_test
