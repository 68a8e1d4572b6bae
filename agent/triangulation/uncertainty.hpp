// What may be wrong, and what that does to a triangulated point, to first order.
//
// An error source is one independent cause: it changes what the triangulation is given (image
// points, relative pose, where camera 1 is in the torso), and so the answer, along one direction.
// The covariance of the answer is the sum over the sources; sources that two pairs of looks have in
// common (focal length, mount, zero) keep their identity this way.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/triangulation/optimal.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed {

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

/// The independent sources of two looks, at most `capacity`; no memory is allocated.
class ErrorSources {
 public:
  /// The most that a head and its camera have: 4 encoder readings, 2 zeros, 1 focal length, 2
  /// coordinates of the centre, 3 of the mount offset, 3 of the mount rotation.
  static constexpr std::size_t capacity = 15;

  /// Throws std::length_error beyond the capacity.
  void add(const ErrorSource& source);
  [[nodiscard]] std::span<const ErrorSource> all() const { return {sources_.data(), count_}; }

 private:
  std::array<ErrorSource, capacity> sources_;
  std::size_t count_ = 0;
};

/// Focal length (one error for both axes) and principal point (per axis) of the one camera that
/// took both views. A sigma of zero adds nothing, here and below.
void add_camera_errors(const TwoViews& views, double focal_sigma_px, double centre_sigma_px,
                       ErrorSources& sources);

/// Encoders (per angle and look), zero (per joint), mount offset and mount rotation (per axis),
/// through the kinematic chain of agent/geometry/head.hpp.
void add_head_errors(const HeadGeometry& head, HeadAngles measured_1, HeadAngles measured_2,
                     const Uncertainty& uncertainty, ErrorSources& sources);

/// Rotation (about each axis of camera 2) and translation (along each) of a relative pose that was
/// measured as such.
void add_relative_pose_errors(double rotation_sigma_rad, double translation_sigma_m,
                              ErrorSources& sources);

/// How sure a solution is. Covariances are NaN unless the inverse depth is positive, the torso's
/// also without a torso.
struct Propagated {
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;
  double residual = not_a_number;        // signed, normalised units
  double residual_sigma = not_a_number;  // of all sources
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
  Eigen::Matrix3d torso_covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
};

/// Propagates the image noise of both views and every source to `solution`. The optimal solution is
/// the orthogonal projection of the measured image points (a 4-vector) onto the three-dimensional
/// surface of points that are images of one scene point (HZ 12.5 and 4.2.5): to first order an
/// error splits into its part along the surface, which moves the point, and its part across, which
/// is the epipolar residual.
///
/// Only first-order terms are kept: with unit image noise the covariance is (J^T J)^-1 of the
/// reprojection at the solution (HZ result 5.10).
[[nodiscard]] Propagated propagate(const TwoViews& views, const ErrorSources& sources,
                                   const InverseDepthPoint& solution);

/// Standard deviation of the baseline's length, metres.
[[nodiscard]] double baseline_sigma_m(const Pose& cam2_from_cam1, const ErrorSources& sources);

}  // namespace gazed
