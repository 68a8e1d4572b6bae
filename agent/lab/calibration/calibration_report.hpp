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

}  // namespace gazed::lab::calibration
