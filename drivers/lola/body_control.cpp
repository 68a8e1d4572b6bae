#include "drivers/lola/body_control.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agent/base/text.hpp"
#include "drivers/lola/state_check.hpp"

namespace gazed::lola {

namespace {

// B-Human plays with 70 % (stiffnessSettings.cfg, 2024).
constexpr double working_stiffness = 0.7;
// From zero to working_stiffness in half a second, a choice: a limp head is not jerked up, and a
// released one sinks slowly.
constexpr double stiffness_per_us = working_stiffness / 500'000.0;
// 45 degrees, where rUNSWift and B-Human 2024 consider a robot fallen.
constexpr double greatest_tilt_rad = std::numbers::pi / 4;
// A robot that is put back on its feet rocks for a while.
constexpr std::int64_t upright_for_us = 1'000'000;
constexpr std::int64_t command_forgotten_us = 2'000'000;
// A head farther behind its set point is not following. A choice: 60 ms at the motors' maximum
// speed.
constexpr double greatest_lead_rad = 0.5;

constexpr std::array head_joints{head_yaw, head_pitch};

double stiffness_of(float said) {
  return std::clamp(static_cast<double>(said), 0.0, 1.0);
}

drivers::JointReading reading(const LolaState& state, std::size_t joint) {
  return {static_cast<double>(state.position_rad[joint]),
          static_cast<double>(state.stiffness[joint]),
          static_cast<double>(state.temperature_c[joint]),
          static_cast<double>(state.current_a[joint]), state.temperature_status[joint]};
}

}  // namespace

void BodyControl::command(const geometry::HeadCommand& command) {
  const auto admitted = drivers::admit(command);
  if (admitted) {
    target_ = admitted;
    target_idle_us_ = 0;
  } else {
    ++refused_commands_;
  }
}

void BodyControl::let_go() {
  letting_go_ = true;
  target_.reset();
}

void BodyControl::release() {
  releasing_ = true;
  let_go();
}

std::optional<LolaOrder> BodyControl::answer(const LolaState& state, std::int64_t now_us) {
  silence_ = reason_for_silence(state, now_us);
  const bool begins = !found_ && agreeing_ < agreeing_states;
  if (begins || !silence_.empty()) {
    interrupted_ = true;
    return std::nullopt;
  }
  const std::int64_t elapsed_us = found_ ? now_us - last_answer_us_ : 0;
  last_answer_us_ = now_us;
  forget_old_command(elapsed_us);
  if (interrupted_) take_over(state);
  watch(state, now_us);
  ramp_stiffness(elapsed_us);
  move_head(state.head(), elapsed_us);
  return order(state);
}

/// Empty if orders may be sent to the robot.
std::string BodyControl::reason_for_silence(const LolaState& state, std::int64_t now_us) {
  const double tilt_rad = torso_tilt_rad(state);
  if (tilt_rad > greatest_tilt_rad) {
    leant_us_ = now_us;
    return base::text("the torso leans by %.2f rad, over %.2f: nothing is sent to the robot",
                      tilt_rad, greatest_tilt_rad);
  }
  if (leant_us_ && now_us - *leant_us_ < upright_for_us)
    return "the torso was not upright just now: nothing is sent to the robot";
  if (!found_) return reason_not_to_begin(state);
  if (interrupted_ && other_joints_ == OtherJoints::hold) {
    if (const std::string joint = out_of_place(state, *found_); !joint.empty())
      return joint + "; nothing is sent to the robot";
  }
  return {};
}

/// A single packet must not decide how the whole body is held: LoLA may send an invalid one first.
std::string BodyControl::reason_not_to_begin(const LolaState& state) {
  if (agreeing_ == 0) first_ = state;
  const std::string changed = changed_since(first_, state);
  if (changed.empty()) {
    ++agreeing_;
    return {};
  }
  agreeing_ = 0;
  return changed + "; nothing is sent to the robot yet";
}

void BodyControl::take_over(const LolaState& state) {
  if (!found_) found_ = {state.position_rad, state.stiffness};
  set_point_.start(state.head());
  // A head outside its limits is not pulled back at once.
  const bool clamped = geometry::greatest_difference(set_point_.angles(), state.head()) >
                       drivers::HeadGuard::follows_within_rad;
  for (const std::size_t joint : head_joints)
    head_stiffness_[joint] = clamped ? 0.0 : stiffness_of(state.stiffness[joint]);
  interrupted_ = false;
}

/// Counts the time during which the head was not told to approach the target.
void BodyControl::forget_old_command(std::int64_t elapsed_us) {
  const bool idle =
      interrupted_ || guard_.backs_off() || !stiff() || elapsed_us >= command_forgotten_us;
  if (idle) target_idle_us_ += elapsed_us;
  if (target_idle_us_ >= command_forgotten_us) target_.reset();
}

void BodyControl::watch(const LolaState& state, std::int64_t now_us) {
  guard_.watch({now_us, reading(state, head_yaw), reading(state, head_pitch)},
               {set_point_.angles(), std::min(head_stiffness_[0], head_stiffness_[1])});
}

BodyControl::HeadStiffness BodyControl::wanted_stiffness() const {
  if (releasing_) return {};
  if (!letting_go_ || !found_) return {working_stiffness, working_stiffness};
  return {stiffness_of(found_->stiffness[head_yaw]), stiffness_of(found_->stiffness[head_pitch])};
}

bool BodyControl::stiff() const {
  return head_stiffness_[0] >= working_stiffness && head_stiffness_[1] >= working_stiffness;
}

void BodyControl::ramp_stiffness(std::int64_t elapsed_us) {
  const HeadStiffness wanted = wanted_stiffness();
  const double step = stiffness_per_us *
                      static_cast<double>(std::clamp<std::int64_t>(elapsed_us, 0, lola_cycle_us));
  for (const std::size_t joint : head_joints) {
    const double missing = wanted[joint] - head_stiffness_[joint];
    head_stiffness_[joint] = std::abs(missing) <= step
                                 ? wanted[joint]
                                 : head_stiffness_[joint] + std::copysign(step, missing);
  }
}

void BodyControl::move_head(geometry::HeadAngles measured, std::int64_t elapsed_us) {
  if (guard_.backs_off()) {
    set_point_.follow(measured, elapsed_us);
    return;
  }
  if (!target_ || !stiff()) return;
  if (geometry::greatest_difference(measured, set_point_.angles()) > greatest_lead_rad) {
    set_point_.stop();
    return;
  }
  const bool at_target = set_point_.step(target_->target, target_->speed_fraction, elapsed_us);
  if (at_target && geometry::greatest_difference(measured, target_->target) <
                       drivers::HeadGuard::follows_within_rad)
    target_.reset();
}

LolaOrder BodyControl::order(const LolaState& state) const {
  LolaOrder order = *found_;
  if (other_joints_ == OtherJoints::release) {
    order.position_rad = state.position_rad;
    order.stiffness.fill(0.0F);
  }
  const geometry::HeadAngles head = set_point_.angles();
  order.position_rad[head_yaw] = static_cast<float>(head.yaw_rad);
  order.position_rad[head_pitch] = static_cast<float>(head.pitch_rad);
  for (const std::size_t joint : head_joints)
    order.stiffness[joint] = static_cast<float>(head_stiffness_[joint]);
  return order;
}

}  // namespace gazed::lola
