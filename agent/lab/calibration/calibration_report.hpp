// What a calibration found: for a person, and as the TOML file that gazed reads.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/lab/calibration/intrinsics.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::lab::calibration {

/// Residuals before and after, every parameter with its standard deviation, what could not be
/// observed, warnings.
[[nodiscard]] std::string report_of(const HeadCalibration& c);
/// `names` are those of the pictures used.
[[nodiscard]] std::string report_of(const Intrinsics& result, std::span<const std::string> names);

/// `settings` with what was calibrated; sigmas of one kind are the largest of their axes. gazed
/// takes axes that meet: an offset between them goes into mount_offset_m (x, y) and neck_offset_m
/// (z), and what that leaves at other pitches than 0 into mount_offset_sigma_m.
[[nodiscard]] settings::Settings calibrated_settings(settings::Settings settings,
                                                     const HeadCalibration& c);
[[nodiscard]] settings::Settings calibrated_settings(settings::Settings settings,
                                                     const Intrinsics& result);

/// The keys of a camera and a head, as gazed's configuration has them, `comment` in front, each
/// line of it behind a #.
[[nodiscard]] std::string calibration_toml(const settings::Settings& settings,
                                           const std::string& comment);

}  // namespace gazed::lab::calibration
