// What is seen of the target in each look, and what becomes of it.
#pragma once

#include <Eigen/Core>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation::all_looks {

/// One look at the target.
struct Look {
  geometry::HeadAngles head;  // measured, at the exposure of the pixel's row
  geometry::Pixel pixel;      // as seen, with lens distortion
  /// As the registration reports it, on top of Uncertainty::pixel_sigma_px; not used of the first
  /// look, whose pixel defines the point.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  /// Rolling shutter: how far the head turned from the first row's exposure to the last's, as
  /// measured, and the standard deviation of each component. Without one all rows are the pixel's.
  geometry::HeadAngles sweep{};
  double sweep_sigma_rad = 0.0;
};

/// What became of a later look. Its numbers are those of its pair with look 1 by the encoders
/// alone.
struct LookVerdict {
  bool used = false;
  /// How the pair came out by itself; TARGET_LOST also for a look that the others contradict.
  Status status = Status::invalid_input;
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;  // of all sources
  /// How far its pixel lies from where everything else expects it: its innovation's chi-square, two
  /// degrees of freedom; as of when it was dropped for a look that the others contradict.
  double chi2 = not_a_number;
  std::string reason;  // why it was left out; empty where it was not
};

}  // namespace gazed::triangulation::all_looks
