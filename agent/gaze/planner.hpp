// The planner: after the step rule's first move, every next look is chosen for what it tells about
// the target's range.
//
// Information is that about the inverse depth of a target whose pixel in look 1 is given: image
// noise and the encoders' errors of every look, look 1's being common to all. What calibration adds
// is the same wherever the head looks and decides nothing. So the ends of the field win, on both
// axes and looking down where that lengthens the baseline, and then they win in turn: looks
// cluster at the ends.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "agent/gaze/step_rule.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/limits.hpp"
#include "agent/geometry/rig.hpp"

namespace gazed::gaze {

/// What is known of the target: its ray in look 1, the inverse depths that it may have, among them
/// the likeliest (1/m along camera 1's optical axis, all positive), and how large it is seen.
struct PlannedTarget {
  Eigen::Vector2d direction_1 = Eigen::Vector2d::Zero();  // normalised
  double inverse_depth_per_m = 0.0;
  double inverse_depth_min_per_m = 0.0;
  double inverse_depth_max_per_m = 0.0;
  double half_size_px = 0.0;
};

/// Whose looks are planned.
struct PlannedHead {
  geometry::Rig rig;
  geometry::HeadLimits limits;
  double least_step_rad = minimum_step_rad;  // of both joints, from one look to the next
};

/// The angles of the next look, as the sensors will measure them; `looks` are those so far, not
/// empty, and the head is at `current`. In the look the target is well inside the image, or
/// most of it, at every inverse depth that it may have; both joints change by at least
/// `least_step_rad`; the straight segment there stays inside the limits. None where no look does
/// all that.
[[nodiscard]] std::optional<geometry::HeadAngles> most_informative_look(
    const PlannedHead& robot, std::span<const geometry::HeadAngles> looks,
    geometry::HeadAngles current, const PlannedTarget& target);

/// Standard deviation of the inverse depth after `looks`, 1/m, by the planner's model. Infinite for
/// looks that tell nothing.
[[nodiscard]] double planned_sigma_per_m(const PlannedHead& robot,
                                         std::span<const geometry::HeadAngles> looks,
                                         const PlannedTarget& target);

/// Gears have play: a joint that comes from the other side rests elsewhere. Where an axis of the
/// move from `from` to `to` goes against `side` (whose signs count), the point `overshoot_rad`
/// beyond `to` from which it is approached in that sense; none when no axis does, or the detour
/// would leave the limits.
[[nodiscard]] std::optional<geometry::HeadAngles> approach_point(const geometry::HeadLimits& limits,
                                                                 geometry::HeadAngles from,
                                                                 geometry::HeadAngles to,
                                                                 geometry::HeadAngles side,
                                                                 double overshoot_rad);

}  // namespace gazed::gaze
