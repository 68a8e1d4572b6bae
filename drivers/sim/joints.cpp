#include "drivers/sim/joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gazed::sim {

namespace {

// Streams of the seed, one for each source of error.
enum Stream : std::uint64_t { settling_stream = 1, encoder_stream, look_stream, velocity_stream };

constexpr double arrived_rad = 1e-7;
constexpr float room_temperature_c = 30.0F;

/// The camera's side of a joint with play: dragged along when the motor has crossed the gap.
double dragged(double camera_rad, double motor_rad, double backlash_rad) {
  return std::clamp(camera_rad, motor_rad - 0.5 * backlash_rad, motor_rad + 0.5 * backlash_rad);
}

}  // namespace

JointCourse::JointCourse(geometry::HeadAngles from, geometry::HeadAngles to,
                         geometry::HeadAngles max_speed_rad_s, double acceleration_rad_s2)
    : from_(from), way_(to - from) {
  const double yaw = std::abs(way_.yaw_rad), pitch = std::abs(way_.pitch_rad);
  if (std::max(yaw, pitch) < arrived_rad) return;
  // Speed and acceleration of the share of the way: what the slower joint allows.
  const double speed =
      1.0 / std::max(yaw / max_speed_rad_s.yaw_rad, pitch / max_speed_rad_s.pitch_rad);
  acceleration_ = acceleration_rad_s2 / std::max(yaw, pitch);
  ramp_s_ = std::min(speed / acceleration_, std::sqrt(1.0 / acceleration_));
  cruise_s_ = 1.0 / (acceleration_ * ramp_s_) - ramp_s_;
}

geometry::HeadAngles JointCourse::at(double time_s) const {
  const double left_s = duration_s() - time_s;
  double share = 1.0;
  if (left_s > 0.0) {
    const double ramp_way = 0.5 * acceleration_ * ramp_s_ * ramp_s_;
    if (time_s < ramp_s_)
      share = 0.5 * acceleration_ * time_s * time_s;
    else if (left_s > ramp_s_)
      share = ramp_way + acceleration_ * ramp_s_ * (time_s - ramp_s_);
    else
      share = 1.0 - 0.5 * acceleration_ * left_s * left_s;
  }
  return {from_.yaw_rad + share * way_.yaw_rad, from_.pitch_rad + share * way_.pitch_rad};
}

geometry::HeadAngles JointCourse::direction() const {
  const double length = std::hypot(way_.yaw_rad, way_.pitch_rad);
  if (length < arrived_rad) return {};
  return {way_.yaw_rad / length, way_.pitch_rad / length};
}

SimJoints::SimJoints(const JointBehaviour& behaviour, geometry::HeadAngles max_speed_rad_s,
                     std::uint64_t seed, std::int64_t utime_us)
    : behaviour_(behaviour),
      max_speed_rad_s_(max_speed_rad_s),
      lag_share_(behaviour.settle_time_constant_s > 0.0
                     ? 1.0 - std::exp(-1e-6 * step_us / behaviour.settle_time_constant_s)
                     : 1.0),
      settling_(seed, settling_stream),
      encoder_(seed, encoder_stream),
      look_(seed, look_stream),
      velocity_noise_(seed, velocity_stream),
      start_us_(utime_us) {
  if (behaviour.max_speed_rad_s)
    max_speed_rad_s_ = {(*behaviour.max_speed_rad_s)[0], (*behaviour.max_speed_rad_s)[1]};
  reset(geometry::HeadAngles{}, utime_us);
}

void SimJoints::advance_to(std::int64_t utime_us) {
  while (start_us_ + steps_ * step_us < utime_us) {
    if (pending_ && pending_->utime_us <= start_us_ + steps_ * step_us) {
      start(*pending_);
      pending_.reset();
    }
    step();
  }
}

void SimJoints::command(const geometry::HeadCommand& command) {
  if (!geometry::finite(command.target) || !(command.speed_fraction > 0.0)) return;
  if (goal_ == command.target) return;  // on its way, or there
  if (command.utime_us > start_us_ + steps_ * step_us)
    pending_ = command;
  else
    start(command);
}

void SimJoints::start(const geometry::HeadCommand& command) {
  const double fraction = std::min(command.speed_fraction, 1.0);
  geometry::HeadAngles rest = limits_.clamp(command.target);
  rest.yaw_rad += behaviour_.settling_error_rad * settling_.symmetric();
  rest.pitch_rad += behaviour_.settling_error_rad * settling_.symmetric();
  course_ =
      JointCourse(motor_, limits_.clamp(rest),
                  {fraction * max_speed_rad_s_.yaw_rad, fraction * max_speed_rad_s_.pitch_rad},
                  behaviour_.acceleration_rad_s2);
  course_start_ = steps_;
  goal_ = command.target;
  draw_look_error();
}

void SimJoints::hold() {
  pending_.reset();
  goal_.reset();
  course_ = JointCourse(motor_, motor_, max_speed_rad_s_, behaviour_.acceleration_rad_s2);
}

void SimJoints::reset(geometry::HeadAngles angles, std::int64_t utime_us) {
  start_us_ = utime_us;
  steps_ = course_start_ = 0;
  last_move_ = -history_steps;
  motor_ = motor_before_ = angles;
  camera_.fill(angles);
  hold();
  draw_look_error();
}

void SimJoints::follow(geometry::HeadAngles angles, std::int64_t utime_us) {
  if (!geometry::finite(angles)) return;
  const std::int64_t steps = (utime_us - start_us_) / step_us - steps_;
  if (steps < 0 || steps > history_steps) return reset(angles, utime_us);
  const geometry::HeadAngles from = motor_;
  for (std::int64_t i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    ++steps_;
    remember({from.yaw_rad + share * (angles.yaw_rad - from.yaw_rad),
              from.pitch_rad + share * (angles.pitch_rad - from.pitch_rad)});
  }
  hold();
}

void SimJoints::step() {
  ++steps_;
  const double time_s = 1e-6 * static_cast<double>((steps_ - course_start_) * step_us);
  geometry::HeadAngles goal = course_.at(time_s);
  if (behaviour_.drift_rad_s > 0.0) {
    const double on_rad = behaviour_.drift_rad_s * std::max(0.0, time_s - course_.duration_s());
    const geometry::HeadAngles direction = course_.direction();
    goal = limits_.clamp(
        goal + geometry::HeadAngles{on_rad * direction.yaw_rad, on_rad * direction.pitch_rad});
  }
  geometry::HeadAngles next{motor_.yaw_rad + lag_share_ * (goal.yaw_rad - motor_.yaw_rad),
                            motor_.pitch_rad + lag_share_ * (goal.pitch_rad - motor_.pitch_rad)};
  const geometry::HeadAngles off = goal - next;
  if (std::max(std::abs(off.yaw_rad), std::abs(off.pitch_rad)) < arrived_rad) next = goal;
  remember(next);
}

void SimJoints::remember(geometry::HeadAngles motor) {
  motor_before_ = motor_;
  motor_ = motor;
  const geometry::HeadAngles before = camera_at(steps_ - 1);
  const geometry::HeadAngles now{
      dragged(before.yaw_rad, motor.yaw_rad, behaviour_.backlash_rad),
      dragged(before.pitch_rad, motor.pitch_rad, behaviour_.backlash_rad)};
  if (!(now == before)) last_move_ = steps_;
  camera_at(steps_) = now;
}

void SimJoints::draw_look_error() {
  look_error_.yaw_rad = behaviour_.encoder_sigma_rad * look_.normal();
  look_error_.pitch_rad = behaviour_.encoder_sigma_rad * look_.normal();
}

double SimJoints::encoded(double angle_rad) {
  const double noisy = angle_rad + behaviour_.encoder_noise_rad * encoder_.normal();
  const double step_rad = behaviour_.encoder_step_rad;
  return step_rad > 0.0 ? step_rad * std::round(noisy / step_rad) + 0.0 : noisy;  // + 0.0: no -0
}

geometry::HeadState SimJoints::measure() {
  const auto speed = [this](double now_rad, double before_rad) {
    return (now_rad - before_rad) / (1e-6 * step_us) +
           behaviour_.velocity_noise_rad_s * velocity_noise_.normal();
  };
  geometry::HeadState state;
  state.utime_us = start_us_ + steps_ * step_us;
  state.measured.yaw_rad = encoded(motor_.yaw_rad + look_error_.yaw_rad);
  state.measured.pitch_rad = encoded(motor_.pitch_rad + look_error_.pitch_rad);
  state.velocity_rad_s.yaw_rad = speed(motor_.yaw_rad, motor_before_.yaw_rad);
  state.velocity_rad_s.pitch_rad = speed(motor_.pitch_rad, motor_before_.pitch_rad);
  if (behaviour_.velocity == Velocity::zero) state.velocity_rad_s = {};
  if (behaviour_.velocity == Velocity::none) {
    constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();
    state.velocity_rad_s = {not_measured, not_measured};
  }
  state.stiffness = 1.0F;
  state.temperature_c = room_temperature_c;
  return state;
}

geometry::HeadAngles SimJoints::camera_angles(std::int64_t utime_us) const {
  const double at =
      std::clamp(static_cast<double>(utime_us - start_us_) / step_us,
                 static_cast<double>(std::max<std::int64_t>(steps_ - history_steps + 1, 0)),
                 static_cast<double>(steps_));
  const auto before = static_cast<std::int64_t>(at);
  const std::int64_t after = std::min(before + 1, steps_);
  const double share = at - static_cast<double>(before);
  const geometry::HeadAngles &a = camera_at(before), &b = camera_at(after);
  return {a.yaw_rad + share * (b.yaw_rad - a.yaw_rad),
          a.pitch_rad + share * (b.pitch_rad - a.pitch_rad)};
}

bool SimJoints::moved_since(std::int64_t utime_us) const {
  return start_us_ + last_move_ * step_us > utime_us;
}

geometry::HeadAngles& SimJoints::camera_at(std::int64_t step) {
  return camera_[static_cast<std::size_t>((step + history_steps) % history_steps)];
}

const geometry::HeadAngles& SimJoints::camera_at(std::int64_t step) const {
  return camera_[static_cast<std::size_t>((step + history_steps) % history_steps)];
}

}  // namespace gazed::sim
