// A camera's controls: exposure, gain, white balance, focus, flips.
#pragma once

#include <string>
#include <vector>

#include "drivers/v4l2/camera_controls.hpp"
#include "drivers/v4l2/video_device.hpp"

namespace gazed::v4l2 {

struct ControlsSet {
  std::vector<std::string> problems;  // what is not as it should be, a sentence each
  /// A flip that is needed and could not be set: the picture would be the wrong way round, and with
  /// it the place of everything in it. Empty when all is well.
  std::string fault;
};

/// Sets what is set in `controls`, automatic functions before the values that they would change: a
/// value without its automatic function being mentioned switches that off. Nothing is clamped: what
/// the camera has not, does not allow or sets otherwise is left as it is, and reported.
[[nodiscard]] ControlsSet set_controls(const VideoDevice& device, const CameraControls& controls,
                                       bool flips_by_extension_unit);

}  // namespace gazed::v4l2
