// The sources of error when two looks triangulate a point.
//
// An error source is one independent cause. It changes the inputs of the triangulation (image
// points, relative pose, camera 1's place in the torso frame), and so the answer, along one
// direction. The covariance of the answer is the sum over the sources.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "agent/geometry/head.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// A small change of a pose b_from_a, in b's axes: rotation becomes (I + [rotation_rad]x) rotation,
/// translation becomes translation + translation_m.
struct PoseChange {
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

/// What one standard deviation of one cause changes.
struct ErrorSource {
  Eigen::Vector2d normalised_1 = Eigen::Vector2d::Zero();
  Eigen::Vector2d normalised_2 = Eigen::Vector2d::Zero();
  PoseChange cam2_from_cam1{};
  PoseChange torso_from_cam1{};
};

/// The independent sources of two looks, at most `capacity` of them; allocates no memory.
class ErrorSources {
 public:
  /// Enough for a head and its camera (4 encoder readings, 2 zeros, 1 focal length, 2 coordinates
  /// of the centre, 2 of the distortion, 3 of the mount offset, 3 of the mount rotation), and for
  /// two cameras (1 focal length and 2 coordinates of the centre each) with 3 errors each of their
  /// relative rotation and translation.
  static constexpr std::size_t capacity = 24;

  /// Throws std::length_error if the capacity is exceeded.
  void add(const ErrorSource& source);
  [[nodiscard]] std::span<const ErrorSource> all() const { return {sources_.data(), count_}; }

 private:
  std::array<ErrorSource, capacity> sources_;
  std::size_t count_ = 0;
};

/// Adds the focal length (one error for both axes) and the principal point (per axis) of the one
/// camera that took both views. Here and below, a sigma of zero adds nothing.
void add_camera_errors(const TwoViews& views, double focal_sigma_px, double centre_sigma_px,
                       ErrorSources& sources);

/// Adds the first two distortion coefficients of that camera.
void add_lens_errors(const TwoViews& views, const geometry::CameraModel& camera,
                     const std::array<double, 2>& distortion_sigma, ErrorSources& sources);

/// The same for two cameras that were calibrated separately, so that no error is common.
void add_separate_camera_errors(const TwoViews& views, double focal_sigma_px,
                                double centre_sigma_px, ErrorSources& sources);

/// Adds encoders (per angle and look), zeros (per joint), mount offset and mount rotation (per
/// axis), propagated through the kinematic chain of agent/geometry/head.hpp.
void add_head_errors(const geometry::Rig& rig, geometry::HeadAngles measured_1,
                     geometry::HeadAngles measured_2, ErrorSources& sources);

/// Adds errors of rotation (about each axis of camera 2) and translation (along each) of a relative
/// pose that was measured directly.
void add_relative_pose_errors(double rotation_sigma_rad, double translation_sigma_m,
                              ErrorSources& sources);

inline constexpr std::size_t image_sources = 4;
/// The noise of both image points as sources, two per point.
[[nodiscard]] std::array<ErrorSource, image_sources> image_noise(const TwoViews& views);

/// Standard deviation of the baseline's length, metres.
[[nodiscard]] double baseline_sigma_m(const geometry::Pose& cam2_from_cam1,
                                      const ErrorSources& sources);

}  // namespace gazed::triangulation
