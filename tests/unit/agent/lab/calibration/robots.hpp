// The robot that the calibration tests take: a V6 whose camera sits 4 degrees and 1.8 degrees off,
// as V6 heads do (HULKs 2024, head.*.json), and what is believed of it.
#pragma once

#include "agent/lab/calibration/head_calibration.hpp"

#include "simulated_looks.hpp"

namespace gazed::lab::calibration {

/// The mount's pitch 0.0209 - 0.0698 rad, its roll 0.0314 rad; the offset up to 3 mm off the
/// profile's.
inline constexpr const char* v6_like_mount_error = R"(
[robot]
mount_rotation_rad = [0.031416, -0.048913, 0.0]
mount_offset_m = [0.06171, -0.002, 0.06164]
)";

/// What the profile says, and how sure it is.
[[nodiscard]] HeadBelief v6_belief();

/// Prints the swing of a fixed object 0.5 m away with the geometry before and after, and expects
/// 1 cm at most after: from two looks each without noise, and by direction with encoder and pixel
/// noise.
void expect_little_swing(const SimulatedLooks& looks, const HeadCalibration& result);

}  // namespace gazed::lab::calibration
