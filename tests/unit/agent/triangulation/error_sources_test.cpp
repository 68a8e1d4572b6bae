#include "agent/triangulation/error_sources.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "agent/geometry/chain.hpp"
#include "agent/triangulation/estimate.hpp"

#include "golden.hpp"
#include "scenes.hpp"

namespace gazed::triangulation::error_sources_test {
namespace {

using Eigen::Vector3d;

TEST(ErrorSources, RelativePose) {
  constexpr double agreement = 0.1;
  constexpr int samples = 10'000;
  constexpr double rotation_sigma_rad = 2e-3, translation_sigma_m = 1e-3;
  const geometry::Pose true_pose{geometry::about_y(-0.3) * geometry::about_x(0.1),
                                 Vector3d(-0.1, 0.02, 0.01)};
  const Vector3d point_m(0.1, -0.05, 0.7);
  const auto views_with = [&](const geometry::Pose& pose) {
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
    geometry::Pose pose = true_pose;
    pose.rotation = geometry::about_x(turn.x()) * geometry::about_y(turn.y()) *
                    geometry::about_z(turn.z()) * pose.rotation;
    pose.translation += translation_sigma_m * random.normal_3();
    const PointEstimate estimate = estimate_point(views_with(pose), errors, open_gate);
    variance += std::pow(estimate.inverse_range_per_m - predicted.inverse_range_per_m, 2) / samples;
  }
  EXPECT_NEAR(std::sqrt(variance), predicted.inverse_range_sigma_per_m,
              agreement * predicted.inverse_range_sigma_per_m);
}

/// Two cameras, each with its own calibration.
struct CameraPair {
  geometry::CameraModel camera_1, camera_2;
  geometry::Pose cam2_from_cam1{geometry::about_y(-0.3), Vector3d(-0.1, 0.02, 0.01)};

  CameraPair() {
    camera_1.focal_px = {600.0, 605.0};
    camera_1.centre_px = {320.0, 240.0};
    camera_2.focal_px = {900.0, 890.0};
    camera_2.centre_px = {300.0, 250.0};
  }

  [[nodiscard]] TwoViews views(const geometry::Pixel& pixel_1,
                               const geometry::Pixel& pixel_2) const {
    return {.cam2_from_cam1 = cam2_from_cam1,
            .point_1 = *image_point(camera_1, pixel_1, Eigen::Matrix2d::Zero()),
            .point_2 = *image_point(camera_2, pixel_2, Eigen::Matrix2d::Zero()),
            .torso_from_cam1 = {}};
  }
};

TEST(ErrorSources, SeparateCameras) {
  constexpr double agreement = 0.1;
  constexpr int samples = 10'000;
  constexpr double focal_sigma_px = 4.0, centre_sigma_px = 2.0;
  const CameraPair truth;
  const Vector3d point_m(0.1, -0.05, 0.7);
  const geometry::Pixel pixel_1 = *geometry::project(truth.camera_1, point_m);
  const geometry::Pixel pixel_2 =
      *geometry::project(truth.camera_2, truth.cam2_from_cam1 * point_m);
  ErrorSources errors;
  add_separate_camera_errors(truth.views(pixel_1, pixel_2), focal_sigma_px, centre_sigma_px,
                             errors);
  EXPECT_EQ(errors.all().size(), 6U);
  const PointEstimate predicted = estimate_point(truth.views(pixel_1, pixel_2), errors, open_gate);
  Random random(6);
  double variance = 0.0;
  for (int i = 0; i < samples; ++i) {
    CameraPair believed = truth;
    for (geometry::CameraModel* camera : {&believed.camera_1, &believed.camera_2}) {
      camera->focal_px.array() += focal_sigma_px * random.normal();
      camera->centre_px += centre_sigma_px * random.normal_2();
    }
    const PointEstimate estimate =
        estimate_point(believed.views(pixel_1, pixel_2), errors, open_gate);
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
  const Observation seen =
      *observe(scene.rig(every_source_and_all().back().uncertainty), scene.looks());
  EXPECT_EQ(seen.errors.all().size(), 15U);
  const auto count = [&seen](const auto& changes) {
    return std::ranges::count_if(seen.errors.all(), changes);
  };
  EXPECT_EQ(count([](const ErrorSource& source) { return !source.normalised_1.isZero(); }), 3)
      << "the camera";
  EXPECT_EQ(count([](const ErrorSource& source) {
              return source.torso_from_cam1.rotation_rad.isZero() &&
                     source.torso_from_cam1.translation_m.isZero();
            }),
            3 + 2)
      << "the camera, and the encoders of look 2";
}

TEST(ErrorSources, TwoCamerasAndTheirPoseFit) {
  const CameraPair cameras;
  ErrorSources errors;
  add_separate_camera_errors(cameras.views({320.0, 240.0}, {320.0, 240.0}), 1.0, 1.0, errors);
  add_relative_pose_errors(1e-3, 1e-3, errors);
  EXPECT_EQ(errors.all().size(), 12U);
}

}  // namespace
}  // namespace gazed::triangulation::error_sources_test
