// Predicted sigmas against the errors that simulated robots make.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <tuple>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/singular_values.hpp"
#include "agent/triangulation/estimate.hpp"

#include "golden.hpp"
#include "scenes.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::triangulation::monte_carlo_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

class MonteCarlo : public testing::TestWithParam<std::tuple<ErrorModel, methods::Method>> {
 protected:
  // The standard deviation of so many is known to 1.1 %, 2.2 % of few.
  static constexpr int samples = test::trials(4'000, 1'000);
  ErrorModel model() const {
    ErrorModel out = std::get<0>(GetParam());
    // The rows of linear MMSE grow with the depth: what the rays miss each other by pulls the point
    // nearer, by the square of it. Mount rotation is then no small error.
    if (method() == methods::Method::linear_mmse) out.uncertainty.mount_rotation_sigma_rad *= 0.1;
    return out;
  }
  methods::Method method() const { return std::get<1>(GetParam()); }
};

std::string test_name(const testing::TestParamInfo<std::tuple<ErrorModel, methods::Method>>& info) {
  std::string method(methods::name(std::get<1>(info.param)));
  std::replace(method.begin(), method.end(), '-', '_');
  return std::get<0>(info.param).name + "_" + method;
}

INSTANTIATE_TEST_SUITE_P(Sources, MonteCarlo,
                         testing::Combine(testing::ValuesIn(every_source_and_all()),
                                          testing::ValuesIn(methods::all_methods)),
                         test_name);

TEST_P(MonteCarlo, ThePredictedSigmasAreThoseOfTheErrors) {
  constexpr double agreement = 0.1;
  const Scene scene = step_rule_scene();
  TwoLooks looks = scene.looks();
  looks.pixel_2_covariance_px2 = model().pixel_2_covariance_px2;
  const PointEstimate predicted =
      estimate_point(scene.rig(model().uncertainty), looks, open_gate, method());
  const double true_inverse_range = scene.inverse_range_per_m();
  ASSERT_LT(predicted.inverse_range_sigma_per_m, 0.3 * true_inverse_range);
  // A prior pulls, by this share of the sigma at most.
  constexpr double rounding = 1e-9, most_pull = 0.05;
  const double tolerance = method() == methods::Method::linear_mmse
                               ? rounding + most_pull * predicted.inverse_range_sigma_per_m
                               : rounding;
  EXPECT_NEAR(predicted.inverse_range_per_m, true_inverse_range, tolerance);
  EXPECT_LT((predicted.torso_point_m - scene.torso_point_m).norm(), tolerance);

  Random random(1);
  double inverse_range_variance = 0.0;
  Matrix3d torso_covariance = Matrix3d::Zero();
  for (int i = 0; i < samples; ++i) {
    const PointEstimate estimate =
        estimate_with_errors(scene, model(), open_gate, method(), random);
    ASSERT_TRUE(estimate.torso_point_m.allFinite()) << estimate.reason;
    inverse_range_variance +=
        std::pow(estimate.inverse_range_per_m - true_inverse_range, 2) / samples;
    const Vector3d error = estimate.torso_point_m - scene.torso_point_m;
    torso_covariance += error * error.transpose() / samples;
  }
  EXPECT_NEAR(std::sqrt(inverse_range_variance), predicted.inverse_range_sigma_per_m,
              agreement * predicted.inverse_range_sigma_per_m);
  // Along each principal axis; an axis that a source hardly moves gets its error from second-order
  // terms of the others, which are not predicted.
  constexpr double negligible = 0.03;  // of the largest sigma
  Matrix3d scaled = predicted.torso_covariance_m2, axes;
  geometry::decompose(scaled, axes);
  const Vector3d variances = scaled.colwise().norm().transpose();
  const double largest_sigma = std::sqrt(variances(2));
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = axes.col(k);
    const double sigma = std::sqrt(variances(k));
    EXPECT_NEAR(std::sqrt(std::max(0.0, axis.dot(torso_covariance * axis))), sigma,
                std::max(agreement * sigma, negligible * largest_sigma))
        << "axis " << k << ": " << axis.transpose();
  }
}

TEST_P(MonteCarlo, TheEpipolarResidualIsChiSquare) {
  Gate gate = open_gate;
  gate.epipolar_chi2_max = 3.841;  // 95 %
  const Scene scene = step_rule_scene();
  Random random(2);
  int refused = 0;
  for (int i = 0; i < samples; ++i) {
    const PointEstimate estimate = estimate_with_errors(scene, model(), gate, method(), random);
    refused += estimate.status == Status::target_lost ? 1 : 0;
  }
  // 5 % less or more than 10 % of the sigma: 3.2 to 7.0 %, and three sigmas of so many samples.
  EXPECT_GT(refused, (test::few_trials ? 0.015 : 0.023) * samples);
  EXPECT_LT(refused, (test::few_trials ? 0.094 : 0.081) * samples);
}

TEST(Propagation, TheInverseRangeIsRightEvenWhereTheRangeIsNot) {
  // A quarter of the range uncertain: the range's own distribution is skewed by then.
  constexpr double agreement = 0.1;
  constexpr int samples = test::trials(20'000, 5'000);
  Scene scene = report_scene();
  scene.head_1 = {-0.1, 0.0};
  scene.head_2 = {0.1, 0.1};
  scene.torso_point_m = {1.35, 0.1, 0.1};
  ErrorModel model;
  model.uncertainty.pixel_sigma_px = 0.7;
  model.uncertainty.encoder_sigma_rad = 1.2e-3;
  const TwoLooks looks = scene.looks();
  const PointEstimate predicted = estimate_point(scene.rig(model.uncertainty), looks, open_gate);
  ASSERT_GT(predicted.inverse_range_sigma_per_m, 0.2 * predicted.inverse_range_per_m);
  ASSERT_LT(predicted.inverse_range_sigma_per_m, 0.3 * predicted.inverse_range_per_m);
  Random random(3);
  double variance = 0.0;
  for (int i = 0; i < samples; ++i) {
    const PointEstimate estimate =
        estimate_with_errors(scene, model, open_gate, methods::Method::optimal, random);
    variance += std::pow(estimate.inverse_range_per_m - predicted.inverse_range_per_m, 2) / samples;
  }
  EXPECT_NEAR(std::sqrt(variance), predicted.inverse_range_sigma_per_m,
              agreement * predicted.inverse_range_sigma_per_m);
}

/// A NAO's two looks and any share of every source.
struct RandomScene {
  Scene scene;
  ErrorModel model;
};

RandomScene random_scene(Random& random) {
  for (;;) {
    RandomScene out{step_rule_scene(), {}};
    Scene& scene = out.scene;
    scene.head_1 = {random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.3)};
    scene.head_2 =
        scene.head_1 + geometry::HeadAngles{random.uniform(-0.6, 0.6), random.uniform(-0.4, 0.4)};
    const Vector3d in_cam1_m = random.uniform(0.2, 1.2) *
                               Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.2, 0.2), 1);
    scene.torso_point_m = geometry::cam_from_torso(scene.head, scene.head_1).inverse() * in_cam1_m;
    const auto up_to = [&random](double sigma) { return random.uniform(0.0, sigma); };
    out.model.uncertainty = {.pixel_sigma_px = up_to(0.7),
                             .encoder_sigma_rad = up_to(1.5e-3),
                             .zero_sigma_rad = up_to(5e-3),
                             .focal_sigma_px = up_to(5.0),
                             .centre_sigma_px = up_to(4.0),
                             .mount_offset_sigma_m = up_to(2e-3),
                             .mount_rotation_sigma_rad = up_to(10e-3)};
    const auto pixel_2 = geometry::project(
        scene.camera, geometry::cam_from_torso(scene.head, scene.head_2) * scene.torso_point_m);
    if (!pixel_2 || !scene.camera.contains(*pixel_2)) continue;
    const PointEstimate predicted =
        estimate_point(scene.rig(out.model.uncertainty), scene.looks(), open_gate);
    if (predicted.inverse_range_sigma_per_m < 0.3 * predicted.inverse_range_per_m) return out;
  }
}

TEST(Propagation, ThePredictedSigmaIsThatOfTheErrorsInAnyScene) {
  // 10 % of what the first order leaves out, and four deviations of so many draws' own 2.2 %.
  constexpr int scenes = test::trials(30, 6), samples = 1'000;
  constexpr double agreement = 0.1 + 4.0 * 0.022;
  Random random(7);
  for (int i = 0; i < scenes; ++i) {
    const auto [scene, model] = random_scene(random);
    const double predicted = estimate_point(scene.rig(model.uncertainty), scene.looks(), open_gate)
                                 .inverse_range_sigma_per_m;
    double variance = 0.0;
    for (int k = 0; k < samples; ++k) {
      const PointEstimate estimate =
          estimate_with_errors(scene, model, open_gate, methods::Method::optimal, random);
      variance += std::pow(estimate.inverse_range_per_m - scene.inverse_range_per_m(), 2) / samples;
    }
    EXPECT_NEAR(std::sqrt(variance) / predicted, 1.0, agreement) << "scene " << i;
  }
}

TEST(Propagation, LinearMmseIsRightOverItsPrior) {
  // The truth is drawn from the prior: only then is Cx_new the covariance of the error. Where the
  // prior is worth as much as the images, every fixed truth has a bias of its own.
  constexpr double agreement = 0.1;
  constexpr int samples = test::trials(20'000, 5'000);
  const geometry::Pose pose{geometry::about_y(-0.1), Vector3d(-0.03, 0.0, 0.005)};
  const methods::Prior prior{.mean_m = {0.0, 0.0, 0.8}, .sigma_m = {0.1, 0.1, 0.1}};
  const double focal_px = 752.0, sigma_px = 1.0;
  Random random(5);
  double normalised_squares = 0.0;  // three for each: the squared Mahalanobis distance
  int counted = 0;
  for (int i = 0; i < samples; ++i) {
    const Vector3d truth_m = prior.mean_m + prior.sigma_m.cwiseProduct(random.normal_3());
    const auto seen = [&](const Vector3d& point_m) {
      return undistorted_point(point_m.hnormalized() + sigma_px / focal_px * random.normal_2(),
                               focal_px, sigma_px);
    };
    const TwoViews views{pose, seen(truth_m), seen(pose * truth_m), {}};
    const PointEstimate estimate =
        estimate_point(views, {}, open_gate, methods::Method::linear_mmse, prior);
    if (!estimate.point_m.allFinite()) continue;
    const Vector3d error = estimate.point_m - truth_m;
    normalised_squares += error.dot(estimate.covariance_m2.inverse() * error);
    ++counted;
  }
  ASSERT_GT(counted, 0.95 * samples);
  EXPECT_NEAR(std::sqrt(normalised_squares / (3.0 * counted)), 1.0, agreement);
}

}  // namespace
}  // namespace gazed::triangulation::monte_carlo_test
