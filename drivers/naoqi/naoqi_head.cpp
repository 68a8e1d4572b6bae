#include "drivers/naoqi/naoqi_head.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"

namespace gazed::naoqi {

namespace {

// The DCM, which reads the sensors, has this cycle; ALMotion's is 20 ms (Aldebaran documentation
// 2.4).
constexpr std::int64_t angles_period_us = 10'000;
constexpr std::int64_t stiffness_period_us = 200'000;
constexpr std::int64_t take_over_again_us = 1'000'000;
// The time error is half of this: 0.125 rad at a saccade's 2.5 rad/s.
constexpr std::int64_t answer_too_late_us = 100'000;
// The guard backs off for 1 s, and the cycle waits 3 s for a head to arrive.
constexpr std::int64_t command_waits_us = 1'500'000;
// A robot that has not reported its angles for this long may be hanging. A command would stay in
// its socket and move the head when the robot recovers, at any later time.
constexpr std::int64_t robot_answers_within_us = 250'000;
// If the target is changed by more than this, it is not just the rounding of the robot's limits.
constexpr double limits_agree_rad = 1e-3;
constexpr std::chrono::milliseconds restored_within{300};

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool plausible(float angle_rad) {
  return std::abs(angle_rad) <= std::numbers::pi_v<float>;  // false for NaN
}

void add(std::string& list, const std::string& item) {
  if (!item.empty()) list += (list.empty() ? "" : "; ") + item;
}

}  // namespace

NaoqiHead::NaoqiHead(NaoqiHeadSettings settings, drivers::Clocks clocks)
    : settings_(std::move(settings)),
      clocks_(std::move(clocks)),
      motion_(wake_up_, settings_.robot, "ALMotion", motion_methods),
      temperatures_(wake_up_, settings_.robot),
      takeover_(motion_, settings_.stiffness) {
  write_joints(angles_question_);
  angles_question_.integer(1, 1);  // 1: the sensors' angles, not the commanded ones
  write_joints(stiffness_question_);
}

NaoqiHead::~NaoqiHead() {
  bool given_back = false;
  await_answers(wake_up_, restored_within, [&] {
    if (motion_.ready() && !std::exchange(given_back, true)) takeover_.give_back();
    motion_.serve(clocks_.monotonic_us());
    temperatures_.serve(clocks_.monotonic_us());
    return given_back ? !motion_.busy() : !takeover_.has_changes();
  });
}

std::optional<geometry::HeadState> NaoqiHead::next_state() {
  serve();
  if (states_.empty()) return std::nullopt;
  return states_.take();
}

void NaoqiHead::serve() {
  const std::int64_t now_us = clocks_.monotonic_us();
  absence_us_ = now_us - all_heard_us_;
  if (!motion_.serve(now_us)) all_heard_us_ = now_us;
  temperatures_.serve(now_us);
  std::int64_t due_us = std::min(motion_.due_us(), temperatures_.due_us());
  if (!motion_.ready()) {
    connected_ = taken_over_ = is_nao_ = false;
  } else {
    if (!std::exchange(connected_, true)) begin_connection();
    const bool is_due = now_us >= next_takeover_us_;
    if (is_nao_ && is_due && !takeover_.done() && !takeover_.under_way()) take_over();
    if (!angles_asked_ && now_us >= angles_asked_us_ + angles_period_us) ask_angles();
    if (!stiffness_asked_ && now_us >= stiffness_asked_us_ + stiffness_period_us) ask_stiffness();
    if (!angles_asked_) due_us = std::min(due_us, angles_asked_us_ + angles_period_us);
  }
  send_waiting();
  wake_up_.at(due_us);
}

void NaoqiHead::begin_connection() {
  angles_asked_ = stiffness_asked_ = false;
  stiffness_.reset();
  measured_.reset();
  model_fault_.clear();
  ask_limits();
  ask_model();
}

/// Runs before anything on the robot is changed.
void NaoqiHead::ask_model() {
  const auto settle = [this](const std::string& model) {
    model_fault_.clear();
    is_nao_ = may_be_nao(model);
    if (is_nao_) return take_over();
    model_fault_ = base::text("the robot says that it is a %s, not a NAO: its head is not moved",
                              base::excerpt(model).c_str());
  };
  if (!motion_.has(get_robot_config)) return settle({});
  motion_.call(get_robot_config, {}, [this, settle](const QiResult& result) {
    if (result.value || result.failure != QiFailure::no_answer) return settle(model_in(result));
    // A robot may be slow to start: ask until it answers.
    if (motion_.ready()) ask_model();
    model_fault_ = "the robot has not said yet what it is: its head is not moved";
  });
}

void NaoqiHead::take_over() {
  next_takeover_us_ = clocks_.monotonic_us() + take_over_again_us;
  takeover_.begin();
}

void NaoqiHead::ask_limits() {
  limits_fault_.clear();
  if (!motion_.has(get_limits)) return;
  for (std::size_t joint = 0; joint < head_joints.size(); ++joint) {
    QiWriter name;
    name.text(head_joints[joint]);
    ++limits_due_;
    motion_.call(get_limits, name.bytes(), [this, joint](const QiResult& result) {
      --limits_due_;
      const auto limits = limits_in(result);
      if (!limits) limits_fault_ = trouble_of(get_limits, result);
      if (limits) own_limits_[joint] = limits;  // otherwise keep the previous ones
    });
  }
}

void NaoqiHead::ask_angles() {
  angles_asked_ = true;
  angles_asked_us_ = clocks_.monotonic_us();
  motion_.call(get_angles, angles_question_.bytes(),
               [this](const QiResult& result) { on_angles(result); });
}

void NaoqiHead::ask_stiffness() {
  stiffness_asked_ = true;
  stiffness_asked_us_ = clocks_.monotonic_us();
  motion_.call(get_stiffnesses, stiffness_question_.bytes(), [this](const QiResult& result) {
    stiffness_asked_ = false;
    stiffness_ = per_joint(result);
  });
}

/// Empty if there is none.
std::string NaoqiHead::trouble_of_angles(const QiResult& result, std::int64_t took_us) const {
  const auto angles = per_joint(result);
  if (!angles) return trouble_of(get_angles, result);
  const auto [yaw, pitch] = *angles;
  if (!plausible(yaw) || !plausible(pitch))
    return base::text("the robot says the head is at (%g, %g) rad", static_cast<double>(yaw),
                      static_cast<double>(pitch));
  // While gazed was not reading, the answer may already have been there.
  if (took_us - absence_us_ > answer_too_late_us)
    return base::text("the head's angles took %.2f s to come", 1e-6 * static_cast<double>(took_us));
  return {};
}

void NaoqiHead::on_angles(const QiResult& result) {
  angles_asked_ = false;
  const std::int64_t now_us = clocks_.monotonic_us();
  const std::int64_t took_us = now_us - angles_asked_us_;
  angles_fault_ = trouble_of_angles(result, took_us);
  if (!angles_fault_.empty() || took_us > answer_too_late_us) {
    ++passed_over_;
    return;
  }
  const PerJoint angles = *per_joint(result);
  longest_answer_us_ = std::max(longest_answer_us_, took_us);
  measured_us_ = now_us;
  const PerJoint celsius = temperatures_.celsius();
  geometry::HeadState state;
  state.utime_us = clocks_.realtime_us() - took_us / 2;
  state.measured = {static_cast<double>(angles[0]), static_cast<double>(angles[1])};
  state.velocity_rad_s = {unknown, unknown};
  state.stiffness = stiffness_ ? std::min((*stiffness_)[0], (*stiffness_)[1])
                               : std::numeric_limits<float>::quiet_NaN();
  state.temperature_c = std::fmax(celsius[0], celsius[1]);
  measured_ = state;
  if (states_.push(state)) ++dropped_;
  watch(state, now_us);
}

void NaoqiHead::watch(const geometry::HeadState& state, std::int64_t now_us) {
  const bool taken_over = is_nao_ && takeover_.done();
  if (taken_over && !std::exchange(taken_over_, true)) {
    order_ = state.measured;
    stiffness_.reset();  // it may be outdated
  }
  const PerJoint celsius = temperatures_.celsius();
  drivers::HeadReading reading{
      now_us,
      {.angle_rad = state.measured.yaw_rad, .temperature_c = celsius[0]},
      {.angle_rad = state.measured.pitch_rad, .temperature_c = celsius[1]}};
  if (stiffness_) {
    reading.yaw.stiffness = (*stiffness_)[0];
    reading.pitch.stiffness = (*stiffness_)[1];
  }
  const bool backed_off = guard_.backs_off();
  guard_.watch(reading, {order_, taken_over_ ? takeover_.stiffness() : 0.0});
  if (guard_.backs_off()) order_ = state.measured;  // follow it wherever it is moved
  // Also at the end, so that it does not return to where it was when this was noticed.
  const bool elsewhere =
      last_command_ && geometry::greatest_difference(last_command_->target, state.measured) >
                           drivers::HeadGuard::follows_within_rad;
  if (elsewhere && guard_.backs_off() != backed_off) stop();
}

void NaoqiHead::command(const geometry::HeadCommand& command) {
  const auto admitted = drivers::admit(command);
  if (!admitted) {
    command_fault_ = drivers::why_not_admitted(command);
    return;
  }
  command_fault_.clear();
  waiting_ = {*admitted, clocks_.monotonic_us()};
  serve();
}

void NaoqiHead::hold() {
  waiting_.reset();
  serve();
  stop();
}

geometry::HeadCommand NaoqiHead::within_own_limits(geometry::HeadCommand command) {
  const geometry::HeadAngles target = command.target;
  const auto [yaw, pitch] = own_limits_;
  if (yaw) command.target.yaw_rad = std::clamp(target.yaw_rad, yaw->min_rad, yaw->max_rad);
  if (pitch)
    command.target.pitch_rad = std::clamp(target.pitch_rad, pitch->min_rad, pitch->max_rad);
  command.target =
      geometry::HeadLimits().clamp(command.target);  // the limits may be narrower at another yaw
  if (geometry::greatest_difference(command.target, target) > limits_agree_rad)
    command_fault_ = base::text(
        "the robot's own limits are narrower than a NAO's: the command (%.3f, %.3f) "
        "rad became (%.3f, %.3f)",
        target.yaw_rad, target.pitch_rad, command.target.yaw_rad, command.target.pitch_rad);
  return command;
}

bool NaoqiHead::may_send() const {
  const bool robot_answers = clocks_.monotonic_us() - measured_us_ <= robot_answers_within_us;
  return taken_over_ && motion_.ready() && measured_ && limits_due_ == 0 && robot_answers &&
         !guard_.backs_off();
}

void NaoqiHead::send_waiting() {
  if (!waiting_) return;
  if (may_send()) {
    send(within_own_limits(std::exchange(waiting_, std::nullopt)->command));
  } else if (clocks_.monotonic_us() - waiting_->since_us > command_waits_us) {
    waiting_.reset();
    command_fault_ = "a command was not sent: the head could not be moved within 1.5 s of it";
  }
}

void NaoqiHead::send(const geometry::HeadCommand& command) {
  last_command_ = command;
  order_ = command.target;
  QiWriter arguments;
  write_set_angles(arguments, command.target, command.speed_fraction);
  motion_.call(set_angles, arguments.bytes(), [this](const QiResult& result) {
    if (!result.value) command_fault_ = trouble_of(set_angles, result);
  });
}

void NaoqiHead::stop() {
  if (!measured_) return;
  order_ = measured_->measured;
  if (!last_command_ || !motion_.ready()) return;  // never moved, or not reachable
  geometry::HeadCommand stay = *last_command_;
  stay.target = measured_->measured;
  if (const auto admitted = drivers::admit(stay)) send(within_own_limits(*admitted));
}

drivers::Health NaoqiHead::health() const {
  drivers::Health health{.dropped = dropped_};
  health.add(drivers::HealthKind::lost, motion_.fault());
  if (!health.ok()) return health;
  health.add(drivers::HealthKind::refused, model_fault_);
  health.add(drivers::HealthKind::refused, angles_fault_);
  for (const std::string* fault :
       {&takeover_.fault(), &guard_.fault(), &command_fault_, &limits_fault_})
    health.add(drivers::HealthKind::disobeyed, *fault);
  return health;
}

std::string NaoqiHead::notes() const {
  std::string all;
  if (longest_answer_us_ > 0)
    add(all, base::text("times of the head's angles are right within %.1f ms",
                        0.5e-3 * static_cast<double>(longest_answer_us_)));
  if (passed_over_ > 0) add(all, base::counted(passed_over_, "answer") + " passed over");
  if (dropped_ > 0) add(all, base::counted(dropped_, "state") + " dropped");
  add(all, temperatures_.fault().empty() ? "" : "no temperatures: " + temperatures_.fault());
  return all.empty() ? all : "NAOqi: " + all;
}

}  // namespace gazed::naoqi
