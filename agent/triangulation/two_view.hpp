// The vocabulary of reconstruction: two views of a point, and what can result from them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::triangulation {

/// The result of looking at a point from several places.
enum class Status : std::uint8_t {
  located,
  target_lost,    // the looks do not see one and the same point
  degenerate,     // no baseline, or the point at an epipole
  behind_camera,  // the rays meet behind a camera
  // The range's sigma exceeds the gate. Position and covariance are still set, unless one sigma of
  // the inverse range reaches 0.
  uncertain,
  invalid_input,  // a number is not finite, or a pixel has no ray
};
inline constexpr int status_count = 6;

/// "LOCATED", "TARGET_LOST", ...
[[nodiscard]] std::string_view name(Status status);

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Where one camera saw the point.
struct ImagePoint {
  Eigen::Vector2d normalised = Eigen::Vector2d::Constant(not_a_number);  // distortion undone
  Eigen::Vector2d distorted = Eigen::Vector2d::Constant(not_a_number);   // (pixel - centre) / focal
  /// d pixel / d normalised, px: the focal length times the identity when nothing is distorted.
  Eigen::Matrix2d pixel_jacobian = Eigen::Matrix2d::Constant(not_a_number);
  /// Noise of this point alone, independent of the other view's.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
};

/// None if the camera model has no ray for the pixel.
[[nodiscard]] std::optional<ImagePoint> image_point(const geometry::CameraModel& camera,
                                                    const geometry::Pixel& pixel,
                                                    const Eigen::Matrix2d& covariance_px2);

/// Covariance of the point's own noise, normalised units.
[[nodiscard]] Eigen::Matrix2d normalised_covariance(const ImagePoint& point);

/// Two looks at one scene point: x2 = R x1 + t.
struct TwoViews {
  geometry::Pose cam2_from_cam1;
  ImagePoint point_1, point_2;
  std::optional<geometry::Pose> torso_from_cam1;  // if there is a torso
};

/// A point reconstructed from two views. Whatever has no meaning under `status` is NaN.
///
/// The inverse range is estimated because its error is close to Gaussian; the range's is not. range
/// = 1 / inverse_range, range_sigma = range^2 * inverse_range_sigma, and the k-sigma interval is
/// inverse_range +- k sigma. Both are measured from camera 1's centre along the corrected ray.
///
/// For two looks, the torso point follows from the camera's through the rig's chain at the measured
/// angles of look 1; for all looks, through the chain of the robot as estimated from them, at the
/// refined angles (all_looks::Estimate::robot and reading).
struct PointEstimate {
  Status status = Status::invalid_input;
  std::string reason;  // in words, with the numbers that decided
  // In camera 1's optical frame.
  Eigen::Vector3d point_m = Eigen::Vector3d::Constant(not_a_number);
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
  // In the torso frame; NaN where those above are, and where there is no torso. This covariance
  // also holds the errors of where camera 1 is: head angles, zero and mount.
  Eigen::Vector3d torso_point_m = Eigen::Vector3d::Constant(not_a_number);
  Eigen::Matrix3d torso_covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
  double range_m = not_a_number;
  double range_sigma_m = not_a_number;
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;
  double parallax_rad = not_a_number;  // angle between the two corrected rays
  /// Epipolar residual of the images, whatever the method: square root of the summed squares of the
  /// smallest corrections of both points that make their rays meet.
  double residual_px = not_a_number;
};

}  // namespace gazed::triangulation
