#include "drivers/lola/set_point.hpp"

#include <algorithm>
#include <cmath>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body.hpp"

namespace gazed::lola {

namespace {

// Orders are 32-bit floats: half a unit in the last place of 2 rad is 1.2e-7. With this margin,
// limits and speeds also hold after rounding.
constexpr double float_margin_rad = 1e-6;

// No-load speeds of HeadYaw and HeadPitch (velocity limits of the NAO's URDFs, V3.2 to V6).
constexpr geometry::HeadAngles greatest_speed_rad_s{8.26797, 7.19407};
// 20 rad/s^2, with which B-Human turns a head (HeadMotionEngine.h, 2024), in units of the maximum
// speed per second.
constexpr double acceleration_per_s = 20.0 / greatest_speed_rad_s.yaw_rad;

constexpr double cycle_s = 1e-6 * static_cast<double>(lola_cycle_us);

geometry::HeadAngles allowed(geometry::HeadAngles angles) {
  return geometry::HeadLimits(float_margin_rad).clamp(angles);
}

double seconds_of(std::int64_t elapsed_us) {
  return std::clamp(1e-6 * static_cast<double>(elapsed_us), 0.0, cycle_s);
}

/// Duration of a move at the maximum speed.
double least_seconds(geometry::HeadAngles way) {
  return std::max(std::abs(way.yaw_rad) / greatest_speed_rad_s.yaw_rad,
                  std::abs(way.pitch_rad) / greatest_speed_rad_s.pitch_rad);
}

geometry::HeadAngles scaled(double factor, geometry::HeadAngles angles) {
  return {factor * angles.yaw_rad, factor * angles.pitch_rad};
}

/// The joints' speeds during a move at the maximum speed; zero if there is no move.
geometry::HeadAngles heading_of(geometry::HeadAngles way) {
  const double seconds = least_seconds(way);
  return seconds > 0.0 ? scaled(1.0 / seconds, way) : geometry::HeadAngles{};
}

}  // namespace

void SetPoint::start(geometry::HeadAngles measured) {
  angles_ = allowed(measured);
  speed_ = 0.0;
}

bool SetPoint::step(geometry::HeadAngles target, double speed_fraction, std::int64_t elapsed_us) {
  constexpr double cycle_change = acceleration_per_s * cycle_s;
  const double seconds = seconds_of(elapsed_us);
  const geometry::HeadAngles way = allowed(target) - angles_;
  const geometry::HeadAngles heading = heading_of(way);
  const double braking = std::sqrt(2.0 * acceleration_per_s * least_seconds(way));
  const double wanted = std::min(speed_fraction, braking);
  // In steps of a cycle, braking may lag by up to two cycles' change at the end.
  const bool too_fast = speed_ > wanted + 2.0 * cycle_change;
  const bool turns = speed_ * least_seconds(heading - heading_) > cycle_change;
  if (too_fast || turns) {
    speed_ = std::max(0.0, speed_ - acceleration_per_s * seconds);
    advance(angles_ + scaled(seconds * speed_, heading_), 1.0, seconds);
    return false;
  }
  heading_ = heading;
  speed_ = std::min(speed_ + acceleration_per_s * seconds, wanted);
  const bool there = advance(target, speed_, seconds);
  if (there) stop();
  return there;
}

void SetPoint::follow(geometry::HeadAngles measured, std::int64_t elapsed_us) {
  speed_ = 0.0;
  advance(measured, 1.0, seconds_of(elapsed_us));
}

// Pitch is clamped at the commanded yaw. This may bend a straight path but makes no joint faster:
// the slopes of the limits' table are at most 0.46, and yaw's largest step is 1.15 times pitch's.
bool SetPoint::advance(geometry::HeadAngles target, double speed_fraction, double seconds) {
  // Margin for the largest steps, the only ones where it matters.
  constexpr double float_share =
      1.0 - float_margin_rad / (cycle_s * greatest_speed_rad_s.pitch_rad);
  const geometry::HeadAngles way = allowed(target) - angles_;
  const double moved_s = float_share * std::clamp(speed_fraction, 0.0, 1.0) * seconds;
  const double needed_s = least_seconds(way);
  if (needed_s > moved_s) {
    const double share = moved_s / needed_s;
    angles_ = allowed(angles_ + scaled(share, way));
    return false;
  }
  angles_ = allowed(target);
  return true;
}

}  // namespace gazed::lola
