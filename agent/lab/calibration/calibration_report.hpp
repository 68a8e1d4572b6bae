// What a calibration found, for a person.
#pragma once

#include <string>

#include "agent/lab/calibration/delay.hpp"
#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/lab/calibration/intrinsics.hpp"

namespace gazed::lab::calibration {

/// Residuals before and after, every parameter with its standard deviation, what could not be
/// observed, warnings.
[[nodiscard]] std::string report_of(const HeadCalibration& c);
[[nodiscard]] std::string report_of(const Intrinsics& result);
[[nodiscard]] std::string report_of(const DelayEstimate& result);

/// What must be done for the numbers to hold, as gazed has no key for an encoder's scale: "yaw
/// angles are multiplied by 0.94000"; empty where the encoders count rightly.
[[nodiscard]] std::string scale_condition(const HeadCalibration& c);

}  // namespace gazed::lab::calibration
