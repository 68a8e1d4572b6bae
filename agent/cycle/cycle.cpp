#include "agent/cycle/cycle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/base/utime.hpp"
#include "agent/gaze/step_rule.hpp"

namespace gazed::cycle {

namespace {

// A recorded head does not obey: a measured move of this much, a fifth of the least step, counts as
// the turn.
constexpr double recorded_turn_rad = 0.02;
// However bad its encoders, a head that has moved by less than this share of the least step has not
// arrived.
constexpr double arrival_share_of_step = 0.8;

}  // namespace

std::string_view name(CycleState state) {
  constexpr std::array<std::string_view, 8> names{"waiting",   "looking",  "turning", "settling",
                                                  "relooking", "locating", "fault",   "stopping"};
  return names[static_cast<std::size_t>(state)];
}

Cycle::Cycle(const geometry::Rig& rig, const CycleSettings& settings, HeadLink head)
    : camera_(rig.camera),
      encoder_sigma_rad_(rig.uncertainty.encoder_sigma_rad),
      limits_(settings.motion.margin_rad),
      settings_(settings),
      head_(std::move(head)),
      saliency_(settings.saliency, camera_.width_px, camera_.height_px),
      attention_(rig, settings.saliency),
      track_(rig, limits_, settings.locate, move_margin_rad(), head_.serve),
      earlier_(rig.uncertainty),
      history_(settings.motion.settle_velocity_rad_s, rig.uncertainty.encoder_sigma_rad) {
  pending_.reserve(camera_.width_px, camera_.height_px, base::PixelFormat::rgb24);
}

CycleOutput Cycle::on_head_state(const geometry::HeadState& state) {
  CycleOutput output;
  follow_a_clock_that_is_set(state.utime_us, output);
  if (!history_.add(state)) return output;
  output.consumed = true;
  counts_.saw_head_state(state.utime_us);
  if (state_ == CycleState::fault && fault_ == Status::head_fault) wake_up(state.utime_us, output);
  if (pending_utime_us_) {
    if (const auto head = history_.during(*pending_utime_us_, readout_us())) {
      const geometry::View view{pending_.view(), head->measured, *pending_utime_us_, head->sweep,
                                head->sweep_sigma_rad};
      pending_utime_us_.reset();
      counts_.other_first += std::exchange(behind_pending_, 0);
      use_view(view, head->still, output);
    } else if (history_.oldest_utime_us() > *pending_utime_us_) {
      drop_pending();  // from before the first state: its angles will never come
    }
  }
  watch_rest(output);
  watch_turn(output);
  return output;
}

CycleOutput Cycle::on_frame(const geometry::Frame& frame) {
  CycleOutput output;
  refused_frame_ = refusal_of(frame);
  counts_.saw_frame(frame.utime_us);
  if (!refused_frame_.empty()) {
    ++counts_.refused;
    return output;
  }
  // While a frame waits for its head angles, later ones are dropped: waiting for the newest could
  // last for ever.
  if (pending_utime_us_) {
    ++behind_pending_;
    return output;
  }
  output.consumed = true;
  last_frame_utime_us_ = frame.utime_us;
  if (state_ == CycleState::fault && fault_ == Status::camera_fault)
    wake_up(frame.utime_us, output);
  if (!wants_frame(frame.utime_us)) {
    ++counts_.turning;
    return output;
  }
  if (const auto head = history_.during(frame.utime_us, readout_us())) {
    use_view({frame.image, head->measured, frame.utime_us, head->sweep, head->sweep_sigma_rad},
             head->still, output);
  } else if (history_.empty() || (history_.oldest_utime_us() <= frame.utime_us &&
                                  history_.newest().utime_us < frame.utime_us + readout_us())) {
    pending_.assign(frame.image);
    pending_utime_us_ = frame.utime_us;
  } else {
    ++counts_.no_angles;
  }
  return output;
}

bool Cycle::may_look_at_frame(std::int64_t utime_us) const {
  const bool on_the_way = state_ == CycleState::turning || state_ == CycleState::settling;
  const bool wakes_up = state_ == CycleState::fault && fault_ == Status::camera_fault;
  return !on_the_way && (wakes_up || wants_frame(utime_us)) && history_.may_be_still_at(utime_us);
}

void Cycle::drop_pending() {
  if (!pending_utime_us_) return;
  pending_utime_us_.reset();
  counts_.no_angles += 1 + std::exchange(behind_pending_, 0);
}

FrameCounts Cycle::frame_counts() const {
  FrameCounts counts = counts_;
  if (pending_utime_us_) counts.no_angles += 1 + behind_pending_;
  return counts;
}

// The report's own steps have none.
double Cycle::move_margin_rad() const {
  return settings_.locate.method == LocateMethod::report ? 0.0 : settings_.motion.move_margin_rad;
}

std::int64_t Cycle::readout_us() const {
  return std::llround(1e6 * settings_.camera.readout_s);
}

bool Cycle::wants_frame(std::int64_t utime_us) const {
  switch (state_) {
    case CycleState::waiting:
    case CycleState::looking:
      return true;
    case CycleState::turning:
    case CycleState::settling:
    case CycleState::relooking:
      return utime_us > command_utime_us_;
    default:
      return false;
  }
}

void Cycle::use_view(const geometry::View& view, bool still, CycleOutput& output) {
  if (state_ == CycleState::waiting) state_ = CycleState::looking;
  if (!still) {
    ++counts_.moving;
    attention_.head_moved();
    return;
  }
  if (state_ == CycleState::looking) {
    ++counts_.looked_at;
    look(view, output);
  } else if (turned(view.head) && !goal_ && !turns_on(view, output)) {
    ++counts_.looked_at;
    relook(view, output);
  } else {
    ++counts_.turning;
  }
}

// A joint with bad encoders can be where it was sent and report another angle: three sigmas of that
// on top.
double Cycle::arrival_tolerance_rad() const {
  const double tolerance_rad =
      std::hypot(settings_.motion.settle_tolerance_rad, 3.0 * encoder_sigma_rad_);
  return std::min(tolerance_rad, std::max(settings_.motion.settle_tolerance_rad,
                                          arrival_share_of_step * gaze::minimum_step_rad));
}

bool Cycle::is_as_commanded(geometry::HeadAngles measured) const {
  return geometry::greatest_difference(measured, commanded_) <= arrival_tolerance_rad();
}

bool Cycle::turned(geometry::HeadAngles measured) const {
  if (head_.obeys) return is_as_commanded(measured);
  const geometry::HeadAngles move = measured - rested_at_;
  return std::hypot(move.yaw_rad, move.pitch_rad) >= recorded_turn_rad;
}

bool Cycle::look_under_way() const {
  return state_ == CycleState::turning || state_ == CycleState::settling ||
         state_ == CycleState::relooking;
}

bool Cycle::planned_look_under_way() const {
  return look_under_way() && track_.views_taken() >= static_cast<int>(triangulation::looks_min);
}

void Cycle::watch_rest(CycleOutput& output) {
  const geometry::HeadState& now = history_.newest();
  const bool looking = state_ == CycleState::looking || state_ == CycleState::waiting;
  if (!looking || !rest_utime_us_ || history_.still_now()) rest_utime_us_ = now.utime_us;
  // A recorded head moves as it did.
  if (!looking || !head_.obeys) return;
  const double restless_s = base::seconds_between(*rest_utime_us_, now.utime_us);
  if (restless_s < settings_.motion.settle_timeout_s) return;
  const geometry::HeadAngles velocity = history_.velocity_now_rad_s();
  end_by_head_fault(
      base::text("the head has not been still for %.1f s: velocity (%.3f, %.3f) rad/s, "
                 "still is below %.3f",
                 restless_s, velocity.yaw_rad, velocity.pitch_rad,
                 settings_.motion.settle_velocity_rad_s),
      now.utime_us, output);
}

void Cycle::watch_turn(CycleOutput& output) {
  if (!look_under_way() || history_.newest().utime_us <= command_utime_us_) return;
  const geometry::HeadState& now = history_.newest();
  const bool there = turned(now.measured);
  if (there && goal_) {
    command(*goal_, now.utime_us, output);
    return;
  }
  state_ = !there ? CycleState::turning
                  : (history_.still_now() ? CycleState::relooking : CycleState::settling);
  if (state_ == CycleState::relooking || !head_.obeys) return;
  const double waited_s = base::seconds_between(command_utime_us_, now.utime_us);
  if (waited_s < settings_.motion.settle_timeout_s) return;
  end_by_head_fault(
      base::text("the head has not settled %.1f s after the command (%.3f, %.3f) rad: it "
                 "is at (%.3f, %.3f)",
                 waited_s, commanded_.yaw_rad, commanded_.pitch_rad, now.measured.yaw_rad,
                 now.measured.pitch_rad),
      now.utime_us, output);
}

Fixation Cycle::new_fixation(std::int64_t utime_us, Status status, std::string reason) const {
  Fixation fixation;
  fixation.utime_us = utime_us;
  fixation.number = fixations_ + 1;
  fixation.status = status;
  fixation.reason = std::move(reason);
  fixation.method = settings_.locate.method;
  fixation.robot = track_.believed_before();
  fixation.duration_s = looked_for_s(utime_us);
  return fixation;
}

double Cycle::looked_for_s(std::int64_t until_us) const {
  return looking_since_us_ ? base::seconds_between(*looking_since_us_, until_us) : 0.0;
}

void Cycle::finish(Fixation fixation, CycleOutput& output) {
  if (fixation.counts) ++fixations_;
  earlier_.hold_against(fixation);
  // Where nothing stood out, nothing was looked at; but what is seen next may be another scene.
  const bool nothing_stood_out =
      fixation.status == Status::no_salient_object &&
      static_cast<double>(fixation.distinctness) < settings_.saliency.distinctness_min;
  if (nothing_stood_out) {
    attention_.head_moved();
  } else {
    attention_.fixation_ended(fixation.utime_us);
  }
  start_looking(fixation.utime_us);
  output.fixation = std::move(fixation);
}

void Cycle::start_looking(std::int64_t after_utime_us) {
  state_ = CycleState::looking;
  looking_since_us_.reset();
  drop_pending();
  rest_utime_us_.reset();
  history_.restart(after_utime_us);
}

void Cycle::wake_up(std::int64_t utime_us, CycleOutput& output) {
  start_looking(utime_us);
  if (must_look_back_) look_back(utime_us, output);
}

void Cycle::report_first_view(Fixation& fixation) const {
  fixation.views = 1;
  fixation.pixel_1 = track_.first().pixel;
  fixation.head_1 = track_.first().head;
  fixation.saliency = first_.saliency;
  fixation.distinctness = first_.distinctness;
  track_.account_for(fixation);
}

void Cycle::end_by_head_fault(std::string reason, std::int64_t utime_us, CycleOutput& output) {
  const bool is_away = planned_look_under_way();
  report_head_fault(std::move(reason), utime_us, output);
  if (is_away) look_back(utime_us, output);
}

void Cycle::report_head_fault(std::string reason, std::int64_t utime_us, CycleOutput& output) {
  // What the looks so far tell of the target is worth more than the fault. A head that goes on
  // failing is reported when the next fixation fails from its start.
  if (look_under_way() && track_.looks_used() >= 2) {
    publish_track(utime_us, reason, output);
    return;
  }
  // A head that fails every time is tried again at once, but reported only every 10 s.
  const bool reported_recently =
      last_head_fault_us_ && base::seconds_between(*last_head_fault_us_, utime_us) < fault_repeat_s;
  if (reported_recently) {
    attention_.fixation_ended(utime_us);
    start_looking(utime_us);
    return;
  }
  last_head_fault_us_ = utime_us;
  Fixation fixation = new_fixation(utime_us, Status::head_fault, std::move(reason));
  if (look_under_way()) report_first_view(fixation);
  finish(std::move(fixation), output);
}

}  // namespace gazed::cycle
