// Predicted covariances against golden values and an independent budget.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "agent/triangulation/estimate.hpp"

#include "golden.hpp"
#include "scenes.hpp"

namespace gazed::triangulation::covariance_test {
namespace {

using Eigen::Vector3d;

TEST(Covariance, GoldenForOnePixelOfNoise) {
  constexpr double tolerance = 1e-9;  // of its largest element
  for (const GoldenCase& golden : golden_cases()) {
    SCOPED_TRACE(golden.name);
    const Eigen::Matrix2d one_px = Eigen::Matrix2d::Identity();
    const geometry::CameraModel camera = golden_camera();
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
    scene.head_1 = geometry::HeadAngles{} - scene.head_2;
    scene.torso_point_m = scene.head.mount_offset_m + Vector3d(row.distance_m, 0.0, 0.0);
    const auto relative_sigma = [&](const geometry::Uncertainty& uncertainty) {
      const PointEstimate estimate =
          estimate_point(scene.head, scene.camera, uncertainty, scene.looks(), open_gate);
      return std::sqrt(estimate.torso_covariance_m2(0, 0)) / row.distance_m;
    };
    geometry::Uncertainty pixels, encoders, focal;
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
    geometry::Uncertainty uncertainty;
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
  geometry::Uncertainty uncertainty;
  uncertainty.zero_sigma_rad = 5e-3;
  const PointEstimate estimate =
      estimate_point(scene.head, scene.camera, uncertainty, scene.looks(), open_gate);
  const double sideways_m = std::sqrt(estimate.torso_covariance_m2(1, 1));
  EXPECT_NEAR(sideways_m, 5e-3 * 0.5, 0.1 * 5e-3 * 0.5);  // sigma times the distance ahead
}

}  // namespace
}  // namespace gazed::triangulation::covariance_test
