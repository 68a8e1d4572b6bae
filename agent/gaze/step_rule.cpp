#include "agent/gaze/step_rule.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace gazed::gaze {

namespace {

// What the rule asks of one axis before any limit: the part of the half field of view that lies
// between the image's centre and the pixel, and the least step where that is less. A change of 0 or
// -0.0 counts as positive.
double wanted_change(double relative_position, double half_field_rad) {
  const double change = relative_position * half_field_rad;
  if (std::abs(change) >= minimum_step_rad) return change;
  return change < 0.0 ? -minimum_step_rad : minimum_step_rad;
}

geometry::HeadAngles wanted_change(const geometry::CameraModel& camera,
                                   const geometry::Pixel& salient) {
  const Eigen::Vector2d size_px(camera.width_px, camera.height_px);
  const Eigen::Vector2d centre_px = (size_px - Eigen::Vector2d::Ones()) / 2.0;
  const Eigen::Vector2d relative = (salient - centre_px).cwiseQuotient(centre_px);
  const double half_width_rad = std::atan(size_px.x() / (2.0 * camera.focal_px.x()));
  const double half_height_rad = std::atan(size_px.y() / (2.0 * camera.focal_px.y()));
  return {wanted_change(-relative.x(), half_width_rad),
          wanted_change(relative.y(), half_height_rad)};
}

// The pitches that a straight segment to `yaw_rad` can end at without leaving the limits on the
// way. The range is empty (min above max) where there is none.
geometry::AngleRange reachable_pitches(const geometry::HeadLimits& limits,
                                       geometry::HeadAngles start, double yaw_rad) {
  geometry::AngleRange reachable = limits.pitch_range(yaw_rad);
  const auto [right, left] = std::minmax(start.yaw_rad, yaw_rad);
  for (const double break_yaw : geometry::HeadLimits::break_yaws_rad()) {
    if (break_yaw <= right || break_yaw >= left) continue;
    const double part = (break_yaw - start.yaw_rad) / (yaw_rad - start.yaw_rad);
    const geometry::AngleRange here = limits.pitch_range(break_yaw);
    reachable.min_rad =
        std::max(reachable.min_rad, start.pitch_rad + (here.min_rad - start.pitch_rad) / part);
    reachable.max_rad =
        std::min(reachable.max_rad, start.pitch_rad + (here.max_rad - start.pitch_rad) / part);
  }
  return reachable;
}

double nearest(geometry::AngleRange allowed, double angle_rad) {
  return std::min(std::max(angle_rad, allowed.min_rad), allowed.max_rad);
}

bool has_room_for_a_step(geometry::AngleRange allowed, double current_rad) {
  return allowed.min_rad <= allowed.max_rad && (allowed.min_rad <= current_rad - minimum_step_rad ||
                                                allowed.max_rad >= current_rad + minimum_step_rad);
}

// Where a change ends that is made to end inside: reduced, or increased where the near limit lies
// further on. Where the reduced change is less than the least step, the least step the other way,
// or as much more as that side's limit asks for. Ends are compared, not changes: (angle + 0.1) -
// angle may round below 0.1, and a step that was just set to the least would be turned round.
double step_within(geometry::AngleRange allowed, double current_rad, double change_rad) {
  const double direction = change_rad < 0.0 ? -1.0 : 1.0;
  const double least = current_rad + direction * minimum_step_rad;
  const double end = nearest(allowed, current_rad + change_rad);
  if ((end - least) * direction >= 0.0) return end;
  return nearest(allowed, current_rad - direction * minimum_step_rad);
}

}  // namespace

geometry::HeadAngles next_look(const geometry::CameraModel& camera,
                               const geometry::HeadLimits& limits, geometry::HeadAngles current,
                               const geometry::Pixel& salient) {
  const geometry::HeadAngles start = limits.clamp(current);
  const geometry::HeadAngles change = wanted_change(camera, salient);
  double yaw = step_within(limits.yaw_range(), start.yaw_rad, change.yaw_rad);
  geometry::AngleRange pitches = reachable_pitches(limits, start, yaw);
  if (!has_room_for_a_step(pitches, start.pitch_rad)) {
    // A long turn along a limit that closes in can leave no pitch (a wide field of view and a large
    // margin: 0.76 to 1.93 rad at margin 0.15). The least step the other way leaves one.
    yaw = start.yaw_rad - std::copysign(minimum_step_rad, yaw - start.yaw_rad);
    pitches = reachable_pitches(limits, start, yaw);
  }
  return {yaw, step_within(pitches, start.pitch_rad, change.pitch_rad)};
}

geometry::HeadAngles with_margin(const geometry::HeadLimits& limits, geometry::HeadAngles current,
                                 geometry::HeadAngles look, double margin_rad) {
  const geometry::HeadAngles start = limits.clamp(current), move = look - start;
  const geometry::HeadAngles wanted =
      look + geometry::HeadAngles{std::copysign(margin_rad, move.yaw_rad),
                                  std::copysign(margin_rad, move.pitch_rad)};
  // Where a longer turn would leave no room for the pitch, the pitch alone gets its margin.
  for (const double yaw : {nearest(limits.yaw_range(), wanted.yaw_rad), look.yaw_rad}) {
    const geometry::AngleRange pitches = reachable_pitches(limits, start, yaw);
    if (pitches.min_rad > pitches.max_rad) continue;
    const double pitch = nearest(pitches, wanted.pitch_rad);
    if ((pitch - look.pitch_rad) * move.pitch_rad >= 0.0) return {yaw, pitch};
  }
  return look;
}

std::optional<geometry::HeadAngles> turn_on(const geometry::HeadLimits& limits,
                                            geometry::HeadAngles from,
                                            geometry::HeadAngles commanded,
                                            geometry::HeadAngles measured, double margin_rad) {
  const geometry::HeadAngles way = commanded - from;
  const auto missing = [](double moved_rad, double way_rad) {
    return std::max(0.0, minimum_step_rad - moved_rad * (way_rad < 0.0 ? -1.0 : 1.0));
  };
  const geometry::HeadAngles short_by{missing(measured.yaw_rad - from.yaw_rad, way.yaw_rad),
                                      missing(measured.pitch_rad - from.pitch_rad, way.pitch_rad)};
  if (short_by == geometry::HeadAngles{}) return std::nullopt;
  const auto longer = [margin_rad](double end_rad, double way_rad, double short_by_rad) {
    return short_by_rad > 0.0 ? end_rad + std::copysign(short_by_rad + margin_rad, way_rad)
                              : end_rad;
  };
  const geometry::HeadAngles goal =
      limits.clamp({longer(commanded.yaw_rad, way.yaw_rad, short_by.yaw_rad),
                    longer(commanded.pitch_rad, way.pitch_rad, short_by.pitch_rad)});
  const auto makes_up = [](double on_rad, double way_rad, double short_by_rad) {
    return short_by_rad > 0.0 && on_rad * (way_rad < 0.0 ? -1.0 : 1.0) >= short_by_rad;
  };
  const geometry::HeadAngles on = goal - commanded;
  const bool helps = makes_up(on.yaw_rad, way.yaw_rad, short_by.yaw_rad) ||
                     makes_up(on.pitch_rad, way.pitch_rad, short_by.pitch_rad);
  if (!helps || !limits.contains_segment(limits.clamp(measured), goal)) return std::nullopt;
  return goal;
}

}  // namespace gazed::gaze
