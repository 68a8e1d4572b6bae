// What gazelab calibrate was given to read and to write, before anything is read.
#pragma once

#include <string>
#include <vector>

#include "agent/lab/calibration/calibrate_options.hpp"

namespace gazed::lab::calibration {

/// Throws std::invalid_argument that names what does not belong together and what is allowed, or
/// std::runtime_error where the one input is not there.
void check_inputs(const CalibrateOptions& options);
/// Whether there is nothing to calibrate from but another program's calibration, to be written as
/// gazed's.
[[nodiscard]] bool is_conversion(const CalibrateOptions& options);
/// Whether the input tells of the camera only: pictures without head angles.
[[nodiscard]] bool is_camera_alone(const CalibrateOptions& options);
/// The inputs, and of a folder the pictures in it.
[[nodiscard]] std::vector<std::string> pictures_of(const CalibrateOptions& options);

}  // namespace gazed::lab::calibration
