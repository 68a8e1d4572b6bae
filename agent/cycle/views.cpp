// What the cycle does with a view: look for the object, aim at it, look again, locate.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"
#include "agent/cycle/cycle.hpp"
#include "agent/gaze/step_rule.hpp"

namespace gazed::cycle {

namespace {

// A worn gear comes to rest a degree or two apart when approached from one side and from the other.
constexpr double gear_play_rad = 0.03;

// Without a salient object for this long the fixation ends: NO_SALIENT_OBJECT is published once,
// not for every frame.
constexpr double looking_s = 1.0;
// A head that falls short of its step again and again is looked through all the same.
constexpr int turns_on_max = 3;
// Angles that leave the limits by more than encoder noise and margin can explain are not believed.
constexpr double limits_slack_rad = 0.1;

}  // namespace

void Cycle::look(const geometry::View& view, CycleOutput& output) {
  if (!looking_since_us_) looking_since_us_ = view.utime_us;
  const saliency::SaliencyResult seen = saliency_.examine(view.image, attention_.context_for(view));
  head_.serve();
  const double looked_s = base::seconds_between(*looking_since_us_, view.utime_us);
  if (attention_.flicker_needs_another_frame() && looked_s < looking_s) return;
  const bool distinct =
      static_cast<double>(seen.distinctness) >= settings_.saliency.distinctness_min &&
      seen.saliency > 0.0F;
  if (distinct) attention_.won(view, seen.peak_px);
  if (distinct && track_.start(view, seen)) {
    output.saliency = UsedSaliency{view.utime_us, seen};
    aim(view, seen, output);
    return;
  }
  if (looked_s < looking_s) return;
  output.saliency = UsedSaliency{view.utime_us, seen};
  std::string reason =
      distinct
          ? base::text("nothing to look for at the most salient place, (%.0f, %.0f) px: %s",
                       seen.peak_px.x(), seen.peak_px.y(), track_.refusal())
          : base::text("distinctness %.2f, at least %.2f is needed",
                       static_cast<double>(seen.distinctness), settings_.saliency.distinctness_min);
  Fixation fixation = new_fixation(view.utime_us, Status::no_salient_object, std::move(reason));
  fixation.views = 1;
  fixation.head_1 = view.head;
  fixation.saliency = seen.saliency;
  fixation.distinctness = seen.distinctness;
  finish(std::move(fixation), output);
}

void Cycle::aim(const geometry::View& view, const saliency::SaliencyResult& seen,
                CycleOutput& output) {
  leave_look();
  must_look_back_ = false;
  first_.saliency = seen.saliency;
  first_.distinctness = seen.distinctness;
  state_ = CycleState::turning;
  const geometry::HeadAngles inside = limits_.clamp(view.head);
  if (is_outside_limits(view.head)) {
    end_by_head_fault(
        base::text("measured head angles (%.3f, %.3f) rad lie outside the limits; nearest allowed: "
                   "(%.3f, %.3f)",
                   view.head.yaw_rad, view.head.pitch_rad, inside.yaw_rad, inside.pitch_rad),
        view.utime_us, output);
    return;
  }
  first_look_ = track_.next_look(inside);
  turn_to(first_look_, view.utime_us, output);
}

void Cycle::leave_look() {
  turned_from_ = rested_at_ = track_.last_head();
  turned_on_ = 0;
}

void Cycle::turn_to(geometry::HeadAngles look, std::int64_t utime_us, CycleOutput& output) {
  state_ = CycleState::turning;
  const geometry::HeadAngles here = limits_.clamp(history_.newest().measured);
  const auto on_the_way =
      head_.obeys ? track_.on_the_way_to(look, here, arrival_tolerance_rad() + gear_play_rad)
                  : std::nullopt;
  attention_.head_moved();
  command(on_the_way.value_or(look), std::max(utime_us, history_.newest().utime_us), output);
  if (on_the_way) goal_ = look;
}

/// With a margin the step rule holds for what is measured of a move, in all rows of the view, as
/// for its command. A recorded head turned on where the one that was recorded did.
bool Cycle::turns_on(const geometry::View& view, CycleOutput& output) {
  if (move_margin_rad() <= 0.0 || turned_on_ >= turns_on_max || !is_as_commanded(view.head)) {
    return false;
  }
  const geometry::HeadAngles moved = view.head - turned_from_;
  const auto least = [](double moved_rad, double sweep_rad) {
    return moved_rad -
           std::copysign(std::min(0.5 * std::abs(sweep_rad), std::abs(moved_rad)), moved_rad);
  };
  const geometry::HeadAngles least_moved{least(moved.yaw_rad, view.sweep.yaw_rad),
                                         least(moved.pitch_rad, view.sweep.pitch_rad)};
  const auto on = gaze::turn_on(limits_, turned_from_, commanded_, turned_from_ + least_moved,
                                move_margin_rad());
  if (!on) return false;
  ++turned_on_;
  rested_at_ = view.head;
  turn_to(*on, view.utime_us, output);
  return true;
}

void Cycle::command(geometry::HeadAngles target, std::int64_t utime_us, CycleOutput& output) {
  goal_.reset();
  commanded_ = target;
  command_utime_us_ = utime_us;
  output.command = geometry::HeadCommand{utime_us, target, settings_.motion.speed_fraction};
}

void Cycle::relook(const geometry::View& view, CycleOutput& output) {
  state_ = CycleState::locating;
  const saliency::SaliencyResult seen = saliency_.examine(view.image, attention_.context_for(view));
  head_.serve();
  output.saliency = UsedSaliency{view.utime_us, seen, false};
  track_.add(view, seen);
  const bool other_fixation = belongs_to_another_fixation(view);
  if (!track_.complete() && !other_fixation) {
    leave_look();
    turn_to(track_.next_look(limits_.clamp(view.head)), view.utime_us, output);
    return;
  }
  last_head_fault_us_.reset();
  publish_track(view.utime_us, {}, output);
  if (other_fixation) {
    output.saliency.reset();  // its map is about to be another one
    look(view, output);
  } else if (track_.views_taken() > static_cast<int>(triangulation::looks_min)) {
    look_back(view.utime_us, output);
  }
}

/// A recording that is joined in the middle of a fixation, or after a gap, is out of step: what is
/// taken for a later look is the first one at something else. Of the last look's object nothing is
/// seen there, and the head is not where it would have been sent.
bool Cycle::belongs_to_another_fixation(const geometry::View& view) const {
  return !head_.obeys && track_.missed_last_look() && !is_as_commanded(view.head) &&
         !is_outside_limits(view.head);
}

bool Cycle::is_outside_limits(geometry::HeadAngles measured) const {
  return geometry::greatest_difference(limits_.clamp(measured), measured) > limits_slack_rad;
}

// Planned looks have the object at the ends of the frame; the step rule's had it near the middle,
// where the next fixation begins. Until the head is on its way it is not still.
void Cycle::look_back(std::int64_t utime_us, CycleOutput& output) {
  if (head_.obeys) command(first_look_, utime_us, output);
  history_.restart(utime_us + setting_off_us);
}

void Cycle::publish_track(std::int64_t utime_us, const std::string& ended, CycleOutput& output) {
  Fixation fixation =
      new_fixation(utime_us, status_of(track_.estimate().status), track_.estimate().reason);
  report_first_view(fixation);
  fixation.utime_us = track_.last_utime_us();
  fixation.estimate = track_.estimate();
  if (fixation.status == Status::located && track_.may_show_motion()) {
    fixation.status = Status::uncertain;
    const int against = track_.looks_against();
    fixation.reason +=
        base::text("; %d looks%s, chi-square %.1f, do not show that the object stands still",
                   track_.looks_used(),
                   against == 0 ? "" : base::text(" against %d", against).c_str(), track_.chi2());
  }
  if (!ended.empty()) {
    fixation.reason +=
        base::text("; it ended after %d views: %s", track_.views_taken(), ended.c_str());
  }
  fixation.views = track_.looks_used() > 0 ? track_.looks_used() : track_.views_taken();
  fixation.head_2 = track_.last().head;
  fixation.pixel_2 = track_.last().pixel;
  finish(std::move(fixation), output);
}

}  // namespace gazed::cycle
