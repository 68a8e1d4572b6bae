// The report's step rule: from the salient pixel of view 1 to the head angles of view 2 (Russcher
// 2011, section 4.2; SPEC 2).
#pragma once

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/limits.hpp"

namespace gazed {

/// The least change of either joint between two looks (Russcher 2011, section 4.2).
inline constexpr double minimum_step_rad = 0.1;

/// The angles of the next look. `current` must lie inside `limits`, and the camera's field of view
/// must be known.
///
/// For every pixel of the image and every such start the straight segment to the result stays
/// inside the limits, and both joints change by at least `minimum_step_rad`.
[[nodiscard]] HeadAngles next_look(const CameraModel& camera, const HeadLimits& limits,
                                   HeadAngles current, const Pixel& salient);

}  // namespace gazed
