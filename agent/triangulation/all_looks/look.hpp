// What each look sees of the target, and whether it is used.
#pragma once

#include <Eigen/Core>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation::all_looks {

/// One look at the target.
struct Look {
  geometry::HeadAngles head;  // measured, when the pixel's row was exposed
  geometry::Pixel pixel;      // as seen, with lens distortion
  /// From the registration, in addition to Uncertainty::pixel_sigma_px. Ignored for the first look,
  /// whose pixel defines the point.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  /// Rolling shutter: the measured turn of the head from the first row's exposure to the last's,
  /// and the standard deviation of each component. Without it, all rows count as exposed with the
  /// pixel's.
  geometry::HeadAngles sweep{};
  double sweep_sigma_rad = 0.0;
};

/// How a later look was used. The numbers are those of its pair with look 1, with the encoders'
/// angles.
struct LookVerdict {
  bool used = false;
  /// Status of the pair by itself; TARGET_LOST also if the others contradict the look.
  Status status = Status::invalid_input;
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;  // from all sources
  /// Chi-square of its innovation, two degrees of freedom: how far its pixel lies from where
  /// everything else predicts it. For a look that was dropped, the value at that time.
  double chi2 = not_a_number;
  std::string reason;  // why it was left out; empty if it was used
};

}  // namespace gazed::triangulation::all_looks
