#include "robots.hpp"

#include <Eigen/Core>
#include <cstdio>
#include <gtest/gtest.h>

#include "agent/geometry/robot.hpp"

#include "swing.hpp"

namespace gazed::lab::calibration {

HeadBelief v6_belief() {
  const geometry::Rig v6 = geometry::robot_profile("nao-v6")->rig;
  return {.model = {.camera = v6.camera, .head = v6.head}, .uncertainty = v6.uncertainty};
}

void expect_little_swing(const SimulatedLooks& looks, const HeadCalibration& result) {
  constexpr double greatest_swing_m = 0.01;      // what calibration must reach
  constexpr double encoder_sigma_rad = 0.00067;  // 12 bit (1.53 mrad / sqrt 12) and 0.5 mrad noise
  constexpr double pixel_sigma_px = 0.3;         // of a saliency target, the profile's
  const Robot truth{looks.truth.camera, looks.truth.head};
  const Robot before{result.before.camera, result.before.head};
  const Robot after{result.after.camera, result.after.head};
  const Eigen::Vector3d object(0.55, 0.03, 0.17);  // 0.49 m from the camera at (0, 0)
  const auto clean = glances_at(truth, object, 0.0, 0.0);
  const auto noisy = glances_at(truth, object, encoder_sigma_rad, pixel_sigma_px);
  const double two_before_m = swing_m(points_by_two_looks(before, clean));
  const double two_after_m = swing_m(points_by_two_looks(after, clean));
  const double direction_before_m = swing_m(points_by_direction(before, noisy));
  const double direction_after_m = swing_m(points_by_direction(after, noisy));
  std::printf(
      "swing over %zu head angles: two looks, no noise %.1f mm before, %.1f mm after; "
      "direction, noise %.1f mm before, %.1f mm after\n",
      clean.size(), 1e3 * two_before_m, 1e3 * two_after_m, 1e3 * direction_before_m,
      1e3 * direction_after_m);
  EXPECT_GT(clean.size(), 20U);
  EXPECT_LT(swing_m(points_by_two_looks(truth, clean)), 1e-6);  // the method itself is exact
  EXPECT_LT(two_after_m, greatest_swing_m);
  EXPECT_LT(direction_after_m, greatest_swing_m);
  EXPECT_GT(direction_before_m, greatest_swing_m);
}

}  // namespace gazed::lab::calibration
