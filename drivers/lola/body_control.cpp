#include "drivers/lola/body_control.hpp"

#include <algorithm>
#include <cmath>

#include "agent/text.hpp"
#include "drivers/lola/state_check.hpp"

namespace gazed {

namespace {

// What B-Human plays with, 70 % (stiffnessSettings.cfg, 2024).
constexpr double working_stiffness = 0.7;
// From nothing to working_stiffness in half a second: a limp head is not jerked up, and one that is
// let go sinks. A choice; rUNSWift takes 1 s for a whole body (LoLA exit).
constexpr double stiffness_per_us = working_stiffness / 500'000.0;
// As rUNSWift and B-Human 2024 give their robots up.
constexpr double greatest_tilt_rad = 0.785398;
// A robot that is being set on its feet again rocks for a while.
constexpr std::int64_t upright_for_us = 1'000'000;
constexpr std::int64_t command_forgotten_us = 2'000'000;

/// Of the head's two joints the lower.
double head_stiffness(const LolaState& state) {
  const float lower = std::min(state.stiffness[head_yaw], state.stiffness[head_pitch]);
  return std::clamp(static_cast<double>(lower), 0.0, 1.0);
}

}  // namespace

void BodyControl::command(const HeadCommand& command) {
  const auto admitted = admit(command);
  if (admitted) {
    target_ = admitted;
  } else {
    ++refused_commands_;
  }
}

void BodyControl::let_go() {
  letting_go_ = true;
  target_.reset();
}

std::optional<LolaOrder> BodyControl::answer(const LolaState& state, std::int64_t now_us) {
  silence_ = reason_for_silence(state, now_us);
  if (!silence_.empty()) {
    interrupted_ = true;
    return std::nullopt;
  }
  if (interrupted_) take_over(state, now_us);
  const std::int64_t elapsed_us = now_us - last_answer_us_;
  last_answer_us_ = now_us;
  const auto reading = [&](std::size_t joint) -> JointReading {
    return {static_cast<double>(state.position_rad[joint]),
            static_cast<double>(state.stiffness[joint]),
            static_cast<double>(state.temperature_c[joint]),
            static_cast<double>(state.current_a[joint]), state.temperature_status[joint]};
  };
  guard_.watch({now_us, reading(head_yaw), reading(head_pitch)},
               {set_point_.angles(), head_stiffness_});
  ramp_stiffness(elapsed_us);
  move_head(state.head(), elapsed_us);
  return order(state);
}

/// Empty when the robot may be told something.
std::string BodyControl::reason_for_silence(const LolaState& state, std::int64_t now_us) {
  const double tilt_rad = torso_tilt_rad(state);
  if (tilt_rad > greatest_tilt_rad) {
    leant_us_ = now_us;
    return text("the torso leans by %.2f rad, over %.2f: nothing is sent to the robot", tilt_rad,
                greatest_tilt_rad);
  }
  if (leant_us_ && now_us - *leant_us_ < upright_for_us)
    return "the torso was not upright just now: nothing is sent to the robot";
  if (interrupted_ && found_ && other_joints_ == OtherJoints::hold) {
    if (const std::string joint = out_of_place(state, *found_); !joint.empty())
      return joint + "; nothing is sent to the robot";
  }
  return {};
}

void BodyControl::take_over(const LolaState& state, std::int64_t now_us) {
  if (!found_) {
    found_ = {state.position_rad, state.stiffness};
    found_stiffness_ = head_stiffness(state);
  } else if (now_us - last_answer_us_ >= command_forgotten_us) {
    target_.reset();
  }
  head_stiffness_ = head_stiffness(state);
  set_point_.start(state.head());
  last_answer_us_ = now_us;
  interrupted_ = false;
}

void BodyControl::ramp_stiffness(std::int64_t elapsed_us) {
  const double wanted = letting_go_ ? found_stiffness_ : working_stiffness;
  const double step = stiffness_per_us *
                      static_cast<double>(std::clamp<std::int64_t>(elapsed_us, 0, lola_cycle_us));
  const double missing = wanted - head_stiffness_;
  head_stiffness_ =
      std::abs(missing) <= step ? wanted : head_stiffness_ + std::copysign(step, missing);
}

void BodyControl::move_head(HeadAngles measured, std::int64_t elapsed_us) {
  if (guard_.backs_off()) {
    set_point_.follow(measured, elapsed_us);
    return;
  }
  if (!target_ || head_stiffness_ < working_stiffness) return;
  const bool told = set_point_.step(target_->target, target_->speed_fraction, elapsed_us);
  if (told && greatest_difference(measured, target_->target) < HeadGuard::follows_within_rad)
    target_.reset();
}

LolaOrder BodyControl::order(const LolaState& state) const {
  LolaOrder order = *found_;
  if (other_joints_ == OtherJoints::release) {
    order.position_rad = state.position_rad;
    order.stiffness.fill(0.0F);
  }
  const HeadAngles head = set_point_.angles();
  order.position_rad[head_yaw] = static_cast<float>(head.yaw_rad);
  order.position_rad[head_pitch] = static_cast<float>(head.pitch_rad);
  order.stiffness[head_yaw] = order.stiffness[head_pitch] = static_cast<float>(head_stiffness_);
  return order;
}

}  // namespace gazed
