#include "agent/triangulation/uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>

#include "agent/triangulation/estimate.hpp"

#include "golden.hpp"
#include "random.hpp"

namespace gazed {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// Nothing is turned away: the sigmas are what is tested.
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr Gate open_gate{
    .relative_sigma_max = unlimited, .epipolar_chi2_max = unlimited, .baseline_sigmas = 0.0};

TEST(Covariance, GoldenForOnePixelOfNoise) {
  constexpr double tolerance = 1e-9;  // of its largest element
  for (const GoldenCase& golden : golden_cases()) {
    SCOPED_TRACE(golden.name);
    const Eigen::Matrix2d one_px = Eigen::Matrix2d::Identity();
    const CameraModel camera = golden_camera();
    const TwoViews views{.cam2_from_cam1 = golden.cam2_from_cam1,
                         .point_1 = *image_point(camera, golden.pixel_1, one_px),
                         .point_2 = *image_point(camera, golden.pixel_2, one_px),
                         .torso_from_cam1 = {}};
    const PointEstimate estimate = estimate_point(views, {}, open_gate);
    EXPECT_LT((estimate.covariance_m2 - golden.covariance_m2).cwiseAbs().maxCoeff(),
              tolerance * golden.covariance_m2.cwiseAbs().maxCoeff());
    EXPECT_TRUE(estimate.torso_covariance_m2.array().isNaN().all()) << "there is no torso";
  }
}

/// Two looks at a scene point, without any error.
struct Scene {
  HeadGeometry head;
  CameraModel camera;
  HeadAngles head_1, head_2;
  Vector3d torso_point_m;

  [[nodiscard]] TwoLooks looks() const {
    return {.head_1 = head_1,
            .head_2 = head_2,
            .pixel_1 = project(camera, cam_from_torso(head, head_1) * torso_point_m).value(),
            .pixel_2 = project(camera, cam_from_torso(head, head_2) * torso_point_m).value()};
  }
};

/// The top camera of the V4 and later at the report's focal length.
Scene report_scene() {
  Scene scene;
  scene.head.mount_offset_m = {0.05871, 0.0, 0.06364};
  scene.camera.focal_px = {752.0, 752.0};
  scene.camera.centre_px = {331.0, 253.0};
  return scene;
}

// Standard deviation of a point straight ahead, along the line of sight and relative to its
// distance, for the head turned from -move/2 to +move/2: rows of an independent budget (numerical
// derivatives; 0.5 px, 1.5 mrad encoders, 2 px of focal length).
struct BudgetRow {
  bool yaw, pitch;
  double distance_m, move_rad;
  double by_pixels, by_encoders, by_focal;
};
constexpr std::array budget_rows{
    BudgetRow{true, false, 0.3, 0.1, 0.047924589197, 0.129702764850, 0.016225355069},
    BudgetRow{true, false, 0.3, 0.8, 0.005059584919, 0.016954363102, 0.014715873039},
    BudgetRow{true, false, 1.5, 0.2, 0.119074699873, 0.282125498231, 0.070243306810},
    BudgetRow{false, true, 0.3, 0.4, 0.011461611558, 0.032574966744, 0.015761953459},
    BudgetRow{false, true, 1.0, 0.4, 0.038569158101, 0.096247617516, 0.046875681357},
};

TEST(Covariance, AgreesWithTheBudgetOfYawAndPitchMoves) {
  constexpr double tolerance = 1e-6;  // relative; of the budget's numerical derivatives
  for (const BudgetRow& row : budget_rows) {
    Scene scene = report_scene();
    const double half = 0.5 * row.move_rad;
    scene.head_2 = {row.yaw ? half : 0.0, row.pitch ? half : 0.0};
    scene.head_1 = HeadAngles{} - scene.head_2;
    scene.torso_point_m = scene.head.mount_offset_m + Vector3d(row.distance_m, 0.0, 0.0);
    const auto relative_sigma = [&](const Uncertainty& uncertainty) {
      const PointEstimate estimate =
          estimate_point(scene.head, scene.camera, uncertainty, scene.looks(), open_gate);
      return std::sqrt(estimate.torso_covariance_m2(0, 0)) / row.distance_m;
    };
    Uncertainty pixels, encoders, focal;
    pixels.pixel_sigma_px = 0.5;
    encoders.encoder_sigma_rad = 1.5e-3;
    focal.focal_sigma_px = 2.0;
    EXPECT_NEAR(relative_sigma(pixels), row.by_pixels, tolerance * row.by_pixels);
    EXPECT_NEAR(relative_sigma(encoders), row.by_encoders, tolerance * row.by_encoders);
    EXPECT_NEAR(relative_sigma(focal), row.by_focal, tolerance * row.by_focal);
  }
}

TEST(Covariance, OneMillimetreOfLeverArmCostsThePartOfTheArmAtAnyRange) {
  constexpr double law_holds_to = 0.02;  // small angles
  for (const double range_m : {0.3, 1.0, 3.0}) {
    Scene scene = report_scene();
    scene.head_1 = {-0.05, 0.0};
    scene.head_2 = {0.05, 0.0};
    scene.torso_point_m = scene.head.mount_offset_m + Vector3d(range_m, 0.0, 0.0);
    Uncertainty uncertainty;
    uncertainty.mount_offset_sigma_m = 1e-3;
    const PointEstimate estimate =
        estimate_point(scene.head, scene.camera, uncertainty, scene.looks(), open_gate);
    EXPECT_NEAR(estimate.inverse_range_sigma_per_m * range_m, 1.0 / 58.71, law_holds_to / 58.71);
  }
}

TEST(Covariance, AYawZeroTurnsTheWorldButNotTheRange) {
  Scene scene = report_scene();
  scene.head_1 = {-0.2, 0.1};
  scene.head_2 = {0.2, 0.3};
  scene.torso_point_m = {0.5, 0.05, 0.15};
  Uncertainty uncertainty;
  uncertainty.zero_sigma_rad = 5e-3;
  const PointEstimate estimate =
      estimate_point(scene.head, scene.camera, uncertainty, scene.looks(), open_gate);
  const double sideways_m = std::sqrt(estimate.torso_covariance_m2(1, 1));
  EXPECT_NEAR(sideways_m, 5e-3 * 0.5, 0.1 * 5e-3 * 0.5);  // sigma times the distance ahead
}

/// What a Monte Carlo run perturbs.
struct Sources {
  std::string name;
  Uncertainty uncertainty;
  Eigen::Matrix2d pixel_2_covariance_px2 = Eigen::Matrix2d::Zero();
};

void PrintTo(const Sources& sources, std::ostream* stream) {
  *stream << sources.name;
}

std::vector<Sources> every_source_and_all() {
  std::vector<Sources> out(9);
  out[0].name = "Pixels";
  out[0].uncertainty.pixel_sigma_px = 0.7;
  out[1].name = "Registration";
  out[1].pixel_2_covariance_px2 << 1.0, 0.5, 0.5, 0.6;
  out[2].name = "Encoders";
  out[2].uncertainty.encoder_sigma_rad = 1.5e-3;
  out[3].name = "Zero";
  out[3].uncertainty.zero_sigma_rad = 3e-3;
  out[4].name = "FocalLength";
  out[4].uncertainty.focal_sigma_px = 10.0;
  out[5].name = "Centre";
  out[5].uncertainty.centre_sigma_px = 2.0;
  out[6].name = "MountOffset";
  out[6].uncertainty.mount_offset_sigma_m = 2e-3;
  out[7].name = "MountRotation";
  out[7].uncertainty.mount_rotation_sigma_rad = 10e-3;
  out[8].name = "All";
  out[8].uncertainty = {.pixel_sigma_px = 0.3,
                        .encoder_sigma_rad = 1e-3,
                        .zero_sigma_rad = 5e-3,
                        .focal_sigma_px = 5.0,
                        .centre_sigma_px = 4.0,
                        .mount_offset_sigma_m = 2e-3,
                        .mount_rotation_sigma_rad = 10e-3};
  out[8].pixel_2_covariance_px2 << 0.2, 0.05, 0.05, 0.1;
  return out;
}

/// The truth is the scene's; what the agent believes of its robot and what it measures is wrong.
PointEstimate estimate_with_errors(const Scene& scene, const TwoLooks& true_looks,
                                   const Sources& sources, const Gate& gate, Random& random) {
  const Uncertainty& u = sources.uncertainty;
  const auto angles = [&](double sigma) {
    const Vector2d error = sigma * random.normal_2();
    return HeadAngles{error.x(), error.y()};
  };
  HeadGeometry head = scene.head;
  head.zero = head.zero + angles(u.zero_sigma_rad);
  head.mount_offset_m += u.mount_offset_sigma_m * random.normal_3();
  head.mount_rotation_rad += u.mount_rotation_sigma_rad * random.normal_3();
  CameraModel camera = scene.camera;
  camera.focal_px.array() += u.focal_sigma_px * random.normal();
  camera.centre_px += u.centre_sigma_px * random.normal_2();
  TwoLooks looks = true_looks;
  looks.head_1 = looks.head_1 + angles(u.encoder_sigma_rad);
  looks.head_2 = looks.head_2 + angles(u.encoder_sigma_rad);
  const Eigen::Matrix2d registration =
      sources.pixel_2_covariance_px2.isZero()
          ? Eigen::Matrix2d::Zero().eval()
          : Eigen::Matrix2d(sources.pixel_2_covariance_px2.llt().matrixL());
  looks.pixel_1 += u.pixel_sigma_px * random.normal_2();
  looks.pixel_2 += u.pixel_sigma_px * random.normal_2() + registration * random.normal_2();
  looks.pixel_2_covariance_px2 = sources.pixel_2_covariance_px2;
  return estimate_point(head, camera, u, looks, gate);
}

/// A move on both axes, as the step rule makes it, at a point off the centre of both views.
Scene step_rule_scene() {
  Scene scene = report_scene();
  scene.head.neck_offset_m = {0.0, 0.0, 0.1265};
  scene.head.mount_rotation_rad = {0.0, 0.0209, 0.0};
  scene.camera.distortion = {-0.1, 0.02, 0.001, -0.001, 0.0};
  scene.head_1 = {0.1, 0.1};
  scene.head_2 = {-0.3, 0.4};
  scene.torso_point_m = {0.55, -0.05, 0.1};
  return scene;
}

class MonteCarlo : public testing::TestWithParam<Sources> {};

INSTANTIATE_TEST_SUITE_P(Sources, MonteCarlo, testing::ValuesIn(every_source_and_all()),
                         [](const auto& case_info) { return case_info.param.name; });

TEST_P(MonteCarlo, ThePredictedSigmasAreThoseOfTheErrors) {
  constexpr double agreement = 0.1;
  constexpr int samples = 10'000;  // a standard deviation is then known to 0.7 %
  const Scene scene = step_rule_scene();
  TwoLooks looks = scene.looks();
  looks.pixel_2_covariance_px2 = GetParam().pixel_2_covariance_px2;
  const PointEstimate predicted =
      estimate_point(scene.head, scene.camera, GetParam().uncertainty, looks, open_gate);
  const double true_inverse_range =
      1.0 / (cam_from_torso(scene.head, scene.head_1) * scene.torso_point_m).norm();
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(predicted.inverse_range_per_m, true_inverse_range, rounding);
  EXPECT_LT((predicted.torso_point_m - scene.torso_point_m).norm(), rounding);
  ASSERT_LT(predicted.inverse_range_sigma_per_m, 0.3 * true_inverse_range);

  Random random(1);
  double inverse_range_variance = 0.0;
  Matrix3d torso_covariance = Matrix3d::Zero();
  for (int i = 0; i < samples; ++i) {
    const PointEstimate estimate =
        estimate_with_errors(scene, looks, GetParam(), open_gate, random);
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
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(predicted.torso_covariance_m2);
  const double largest_sigma = std::sqrt(axes.eigenvalues()(2));
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = axes.eigenvectors().col(k);
    const double sigma = std::sqrt(std::max(0.0, axes.eigenvalues()(k)));
    EXPECT_NEAR(std::sqrt(axis.dot(torso_covariance * axis)), sigma,
                std::max(agreement * sigma, negligible * largest_sigma))
        << "axis " << k << ": " << axis.transpose();
  }
}

TEST_P(MonteCarlo, TheEpipolarResidualIsChiSquare) {
  constexpr int samples = 10'000;
  Gate gate = open_gate;
  gate.epipolar_chi2_max = 3.841;  // 95 %
  const Scene scene = step_rule_scene();
  const TwoLooks looks = scene.looks();
  Random random(2);
  int refused = 0;
  for (int i = 0; i < samples; ++i) {
    const PointEstimate estimate = estimate_with_errors(scene, looks, GetParam(), gate, random);
    refused += estimate.status == Status::target_lost ? 1 : 0;
  }
  // 5 % less or more than 10 % of the sigma: 3.2 to 7.0 %
  EXPECT_GT(refused, 0.032 * samples);
  EXPECT_LT(refused, 0.070 * samples);
}

TEST(Propagation, TheInverseRangeIsRightEvenWhereTheRangeIsNot) {
  // A quarter of the range uncertain: the range's own distribution is skewed by then.
  constexpr double agreement = 0.1;
  constexpr int samples = 20'000;
  Scene scene = report_scene();
  scene.head_1 = {-0.1, 0.0};
  scene.head_2 = {0.1, 0.1};
  scene.torso_point_m = {1.35, 0.1, 0.1};
  Sources sources;
  sources.uncertainty.pixel_sigma_px = 0.7;
  sources.uncertainty.encoder_sigma_rad = 1.2e-3;
  const TwoLooks looks = scene.looks();
  const PointEstimate predicted =
      estimate_point(scene.head, scene.camera, sources.uncertainty, looks, open_gate);
  ASSERT_GT(predicted.inverse_range_sigma_per_m, 0.2 * predicted.inverse_range_per_m);
  ASSERT_LT(predicted.inverse_range_sigma_per_m, 0.3 * predicted.inverse_range_per_m);
  Random random(3);
  double variance = 0.0;
  for (int i = 0; i < samples; ++i) {
    const PointEstimate estimate = estimate_with_errors(scene, looks, sources, open_gate, random);
    variance += std::pow(estimate.inverse_range_per_m - predicted.inverse_range_per_m, 2) / samples;
  }
  EXPECT_NEAR(std::sqrt(variance), predicted.inverse_range_sigma_per_m,
              agreement * predicted.inverse_range_sigma_per_m);
}

TEST(Propagation, RelativePoseErrors) {
  constexpr double agreement = 0.1;
  constexpr int samples = 10'000;
  constexpr double rotation_sigma_rad = 2e-3, translation_sigma_m = 1e-3;
  const Pose true_pose{rotation_y(-0.3) * rotation_x(0.1), Vector3d(-0.1, 0.02, 0.01)};
  const Vector3d point_m(0.1, -0.05, 0.7);
  const auto views_with = [&](const Pose& pose) {
    return TwoViews{.cam2_from_cam1 = pose,
                    .point_1 = undistorted_point(point_m.hnormalized(), 752.0, 0.0),
                    .point_2 = undistorted_point((true_pose * point_m).hnormalized(), 752.0, 0.0),
                    .torso_from_cam1 = {}};
  };
  ErrorSources errors;
  add_relative_pose_errors(rotation_sigma_rad, translation_sigma_m, errors);
  const PointEstimate predicted = estimate_point(views_with(true_pose), errors, open_gate);
  Random random(4);
  double variance = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Vector3d turn = rotation_sigma_rad * random.normal_3();
    Pose pose = true_pose;
    pose.rotation =
        rotation_x(turn.x()) * rotation_y(turn.y()) * rotation_z(turn.z()) * pose.rotation;
    pose.translation += translation_sigma_m * random.normal_3();
    const PointEstimate estimate = estimate_point(views_with(pose), errors, open_gate);
    variance += std::pow(estimate.inverse_range_per_m - predicted.inverse_range_per_m, 2) / samples;
  }
  EXPECT_NEAR(std::sqrt(variance), predicted.inverse_range_sigma_per_m,
              agreement * predicted.inverse_range_sigma_per_m);
}

TEST(ErrorSources, MoreThanAHeadHasAreRefused) {
  ErrorSources sources;
  for (std::size_t i = 0; i < ErrorSources::capacity; ++i) sources.add({});
  EXPECT_THROW(sources.add({}), std::length_error);
}

TEST(ErrorSources, AHeadAndItsCameraFit) {
  const Scene scene = step_rule_scene();
  const TwoLooks looks = scene.looks();
  const Uncertainty all = every_source_and_all().back().uncertainty;
  const TwoViews views{.cam2_from_cam1 = cam2_from_cam1(scene.head, scene.head_1, scene.head_2),
                       .point_1 = *image_point(scene.camera, looks.pixel_1, {}),
                       .point_2 = *image_point(scene.camera, looks.pixel_2, {}),
                       .torso_from_cam1 = {}};
  ErrorSources sources;
  add_camera_errors(views, all.focal_sigma_px, all.centre_sigma_px, sources);
  add_head_errors(scene.head, scene.head_1, scene.head_2, all, sources);
  EXPECT_EQ(sources.all().size(), 15U);
}

}  // namespace
}  // namespace gazed
