// What a calibration found, as the TOML file that gazed reads.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/lab/calibration/intrinsics.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::lab::calibration {

/// gazed takes axes that meet. What that leaves of an offset between them at any pitch from -60 to
/// 60 degrees, at most: 2 sin(pitch / 2) times its x.
[[nodiscard]] double left_by_meeting_axes_m(const Eigen::Vector3d& axis_offset_m);

/// `settings` with what was calibrated; sigmas of one kind are the largest of their axes. gazed
/// takes axes that meet: an offset between them goes into mount_offset_m (x, y) and neck_offset_m
/// (z), and what that leaves at other pitches than 0 into mount_offset_sigma_m.
[[nodiscard]] settings::Settings calibrated_settings(settings::Settings settings,
                                                     const HeadCalibration& c);
[[nodiscard]] settings::Settings calibrated_settings(settings::Settings settings,
                                                     const Intrinsics& result);

/// The camera with its sigmas as the whole image scaled to `width_px` has them.
void scale_camera(settings::Settings& settings, int width_px);

/// Throws std::invalid_argument when gazed would refuse one of the keys of a camera and a head.
void check_read_back(const settings::Settings& settings);

/// The camera's times are written where they were measured only: the profile's depend on the
/// driver.
enum class Timing : std::uint8_t { left_out, written };

/// The keys of a camera and a head, as gazed's configuration has them, `comment` in front, each
/// line of it behind a #.
[[nodiscard]] std::string calibration_toml(const settings::Settings& settings,
                                           const std::string& comment,
                                           Timing timing = Timing::left_out);

}  // namespace gazed::lab::calibration
