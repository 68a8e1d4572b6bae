// The report's step rule: from the salient pixel of view 1 to the head angles of view 2 (Russcher
// 2011, section 4.2). And what keeps it in the move as well as in the command, since joints miss
// their commands by as much as a fifth of the least step.
#pragma once

#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/limits.hpp"

namespace gazed::gaze {

/// The least change of either joint between two looks (Russcher 2011, section 4.2).
inline constexpr double minimum_step_rad = 0.1;

/// The angles of the next look. The field of view of `camera` must be known and `current` be inside
/// `limits`; a start outside is taken as the nearest one inside.
///
/// Wanted is a turn that brings the pixel to the image's centre (linear in the pixel), at least
/// `minimum_step_rad` on each axis. It is reduced until it is inside: yaw first, then pitch, so
/// that its end and the straight segment to it respect the pitch limits of every yaw on the way. An
/// axis whose reduced change is too small goes the other way. Where no pitch keeps the segment
/// inside, yaw goes the other way.
///
/// For every pixel and every start inside, the segment to the result stays inside the limits, and
/// both joints change by at least `minimum_step_rad`.
[[nodiscard]] geometry::HeadAngles next_look(const geometry::CameraModel& camera,
                                             const geometry::HeadLimits& limits,
                                             geometry::HeadAngles current,
                                             const geometry::Pixel& salient);

/// A move from `current` to `look`, on both axes longer by `margin_rad`, or by as much of it as the
/// limits leave room for, at the end and on the way. No axis becomes shorter.
[[nodiscard]] geometry::HeadAngles with_margin(const geometry::HeadLimits& limits,
                                               geometry::HeadAngles current,
                                               geometry::HeadAngles look, double margin_rad);

/// Of a move that was commanded to go from `from` to `commanded` and came to rest at `measured`:
/// where the head is to go on to when an axis fell short of `minimum_step_rad`, by what is missing
/// and `margin_rad`. None where both axes made their step, and where the limits leave no room for
/// what is missing.
[[nodiscard]] std::optional<geometry::HeadAngles> turn_on(const geometry::HeadLimits& limits,
                                                          geometry::HeadAngles from,
                                                          geometry::HeadAngles commanded,
                                                          geometry::HeadAngles measured,
                                                          double margin_rad);

}  // namespace gazed::gaze
