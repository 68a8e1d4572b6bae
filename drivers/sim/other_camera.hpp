// Whether the camera that is configured can be the one that is simulated.
#pragma once

#include <string>

#include "agent/geometry/rig.hpp"

namespace gazed::sim {

/// What is wrong, for the user, where the simulated camera's focal length or centre is off by more
/// than five of the configured sigmas: a calibration of another camera, mostly. Else empty.
[[nodiscard]] std::string other_camera(const geometry::CameraModel& simulated,
                                       const geometry::Rig& configured);

}  // namespace gazed::sim
