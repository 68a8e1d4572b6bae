// A camera's controls: exposure, gain, white balance, focus, flips.
#pragma once

#include <string>
#include <vector>

#include "agent/camera_controls.hpp"
#include "drivers/v4l2/video_device.hpp"

namespace gazed {

/// Sets what is set in `controls`, automatic functions before the values that they would change: a
/// value without its automatic function being mentioned switches that off. Nothing is clamped: what
/// the camera has not, does not allow or sets otherwise is left as it is, and told, a sentence
/// each.
[[nodiscard]] std::vector<std::string> set_controls(const VideoDevice& device,
                                                    const CameraControls& controls,
                                                    bool flips_by_extension_unit);

}  // namespace gazed
