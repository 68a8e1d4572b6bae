// The words of reconstruction: what two looks at a point may come to.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace gazed {

/// How a fixation ended. The numbers are those of located_point_t (DESIGN 4.2); invalid_input never
/// leaves the library.
enum class Status : std::int8_t {
  located = 0,
  no_salient_object = 1,
  target_lost = 2,
  degenerate = 3,
  behind_camera = 4,
  uncertain = 5,
  head_fault = 6,
  camera_fault = 7,
  invalid_input = 8,
};
inline constexpr int status_count = 9;

/// "LOCATED", "NO_SALIENT_OBJECT", ...
[[nodiscard]] std::string_view name(Status status);

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A point reconstructed from two views, in camera 1's optical frame. What has no meaning under
/// `status` is NaN.
///
/// The inverse range is what is estimated: its error is near Gaussian, the range's is not. range =
/// 1 / inverse_range, range_sigma = range^2 * inverse_range_sigma; the k-sigma interval is
/// inverse_range +- k sigma.
struct PointEstimate {
  Status status = Status::invalid_input;
  std::string reason;  // in words, with the numbers that decided
  Eigen::Vector3d point_m = Eigen::Vector3d::Constant(not_a_number);
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
  double range_m = not_a_number;  // from camera 1's centre
  double range_sigma_m = not_a_number;
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;
  double parallax_rad = not_a_number;  // angle between the two corrected rays
  double residual_px =
      not_a_number;  // epipolar residual: root of the summed squared corrections of both points
};

}  // namespace gazed
