#include "drivers/head_guard.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/geometry/limits.hpp"

namespace gazed::drivers {

namespace {

// A joint that does not follow has this long to approach its set point: 83 cycles of 12 ms, after
// which rUNSWift declares a motor without current to have lost its stiffness (LoLATouch.cpp,
// release 2022).
constexpr std::int64_t stuck_after_us = 1'000'000;
// A joint that moved by this much is on its way, not stuck: six steps of its 12-bit encoder.
constexpr double moves_rad = 0.01;
// Somebody else moves it: a joint leaves a constant set point by more than any overshoot. This long
// after a new set point it may still be coming back from the last one (ALMotion answers a command
// within a few of its 20 ms; a joint at full speed brakes from 8 rad/s in 0.4 s at 20
// rad/s^2).
constexpr double pushed_rad = 0.087;  // 5 degrees
constexpr std::int64_t pushed_for_us = 100'000;
constexpr std::int64_t pushed_after_us = 500'000;
// Half of what was set, for half a second, a choice: the robot itself reduces a hot joint's
// stiffness somewhat, and setting stiffness through NAOqi takes a few of its cycles.
constexpr double stiff_enough_share = 0.5;
constexpr std::int64_t soft_for_us = 500'000;
// Off its set point without current: half of the 83 cycles that rUNSWift waits (above), because a
// sinking joint is out of place meanwhile.
constexpr std::int64_t unpowered_for_us = 500'000;
// A softer joint hangs in its gears and is not expected to follow.
constexpr double follows_from_stiffness = 0.3;
// Used for readings without a status; otherwise the robot's status decides (1: it begins to reduce
// the stiffness). Its own limit is not published; this one is a choice. Cooled down means 5 C
// below.
constexpr double hot_c = 75.0;
constexpr double cooled_c = 70.0;
// After a gap this long, earlier observations no longer count.
constexpr std::int64_t longest_gap_us = 250'000;

// A fault is over this long after backing off: longer than it takes to notice it again.
constexpr std::int64_t well_after_us = 1'200'000;

struct NamedJoint {
  const char* name;
  const JointReading& joint;
};

std::array<NamedJoint, 2> joints_of(const HeadReading& reading) {
  return {{{"HeadYaw", reading.yaw}, {"HeadPitch", reading.pitch}}};
}

std::string heat_text(const NamedJoint& hot) {
  const auto& [name, joint] = hot;
  if (joint.temperature_c > hot_c)
    return base::text("%s is too hot: %.0f C, over %.0f C", name, joint.temperature_c, hot_c);
  if (joint.temperature_status > 0)
    return base::text("%s is too hot: the robot gives it temperature status %d (normal is 0)", name,
                      joint.temperature_status);
  return base::text("%s is still too hot: %.0f C, over %.0f C", name, joint.temperature_c,
                    cooled_c);
}

double seconds(std::int64_t microseconds) {
  return 1e-6 * static_cast<double>(microseconds);
}

}  // namespace

std::optional<geometry::HeadCommand> admit(const geometry::HeadCommand& command) {
  if (!geometry::finite(command.target) || !(command.speed_fraction > 0.0)) return std::nullopt;
  geometry::HeadCommand admitted = command;
  admitted.target = geometry::HeadLimits().clamp(command.target);
  admitted.speed_fraction = std::min(command.speed_fraction, 1.0);
  return admitted;
}

std::string why_not_admitted(const geometry::HeadCommand& command) {
  return base::text("a command to (%g, %g) rad at speed %g is not a valid command",
                    command.target.yaw_rad, command.target.pitch_rad, command.speed_fraction);
}

void HeadGuard::watch(const HeadReading& reading, const HeadOrder& order) {
  const bool interrupted = !last_us_ || reading.time_us - *last_us_ > longest_gap_us;
  last_us_ = reading.time_us;
  if (interrupted || backs_off_) start(reading, order);
  if (heat(reading)) {
    back_off(reading.time_us);
    return;
  }
  backs_off_ = backs_off_ && reading.time_us < back_off_until_us_;
  if (backs_off_) return;
  if (std::string noticed = trouble(reading, order); !noticed.empty()) {
    fault_ = std::move(noticed);
    back_off(reading.time_us);
    return;
  }
  clear_when_well(reading, order);
}

void HeadGuard::back_off(std::int64_t time_us) {
  backs_off_ = true;
  back_off_until_us_ = time_us + back_off_us;
  unwell_us_ = back_off_until_us_;
}

bool HeadGuard::heat(const HeadReading& reading) {
  const std::array<bool, 2> before = too_hot_;
  const auto joints = joints_of(reading);
  const NamedJoint* first = nullptr;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointReading& joint = joints[i].joint;
    too_hot_[i] =
        joint.temperature_status > 0 || joint.temperature_c > (before[i] ? cooled_c : hot_c);
    if (too_hot_[i] && first == nullptr) first = &joints[i];
  }
  if (first != nullptr && too_hot_ != before) fault_ = heat_text(*first);
  return first != nullptr;
}

void HeadGuard::start(const HeadReading& reading, const HeadOrder& order) {
  following_[0].start(reading.time_us, reading.yaw, order.set_point.yaw_rad);
  following_[1].start(reading.time_us, reading.pitch, order.set_point.pitch_rad);
}

/// Empty if there is none.
std::string HeadGuard::trouble(const HeadReading& reading, const HeadOrder& order) {
  const std::array set_points{order.set_point.yaw_rad, order.set_point.pitch_rad};
  const auto joints = joints_of(reading);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    std::string found = following_[i].trouble(joints[i].name, reading.time_us, joints[i].joint,
                                              set_points[i], order.stiffness);
    if (!found.empty()) return found;
  }
  return {};
}

void HeadGuard::clear_when_well(const HeadReading& reading, const HeadOrder& order) {
  const geometry::HeadAngles measured{reading.yaw.angle_rad, reading.pitch.angle_rad};
  if (geometry::greatest_difference(measured, order.set_point) > follows_within_rad ||
      order.stiffness < follows_from_stiffness)
    unwell_us_ = reading.time_us;
  if (reading.time_us - unwell_us_ >= well_after_us) fault_.clear();
}

void HeadGuard::Following::start(std::int64_t time_us, const JointReading& joint,
                                 double set_point) {
  set_point_rad = set_point;
  rest_rad = joint.angle_rad;
  set_us = rest_us = near_us = stiff_us = powered_us = time_us;
}

std::string HeadGuard::Following::trouble(const char* name, std::int64_t time_us,
                                          const JointReading& joint, double set_point,
                                          double stiffness) {
  if (stiffness < follows_from_stiffness) {
    start(time_us, joint, set_point);
    return {};
  }
  if (!(joint.stiffness < stiff_enough_share * stiffness)) stiff_us = time_us;
  if (time_us - stiff_us >= soft_for_us)
    return base::text("%s has lost its stiffness: %.2f, told %.2f", name, joint.stiffness,
                      stiffness);

  if (set_point != set_point_rad) set_us = time_us;
  set_point_rad = set_point;
  const double off_rad = std::abs(joint.angle_rad - set_point);
  if (off_rad <= follows_within_rad || std::abs(joint.angle_rad - rest_rad) > moves_rad) {
    rest_rad = joint.angle_rad;
    rest_us = time_us;
  }
  const bool unpowered = joint.current_a == 0.0 && off_rad > follows_within_rad;
  if (!unpowered) powered_us = time_us;
  if (time_us - powered_us >= unpowered_for_us)
    return base::text("%s has no power: it draws no current at %.3f rad, told %.3f", name,
                      joint.angle_rad, set_point);
  if (time_us - rest_us >= stuck_after_us)
    return base::text("%s is stuck: at %.3f rad for %.1f s, told %.3f", name, joint.angle_rad,
                      seconds(time_us - rest_us), set_point);

  // A motor without current holds nothing and sinks by itself.
  const bool may_come_back = time_us - set_us < pushed_after_us;
  nearest_rad = may_come_back ? off_rad : std::min(nearest_rad, off_rad);
  if (unpowered || off_rad - nearest_rad <= pushed_rad) near_us = time_us;
  if (time_us - near_us >= pushed_for_us)
    return base::text("somebody else moves the head: %s at %.3f rad, told %.3f", name,
                      joint.angle_rad, set_point);
  return {};
}

}  // namespace gazed::drivers
