#include "drivers/lola/set_point.hpp"

#include <algorithm>
#include <cmath>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body.hpp"

namespace gazed {

namespace {

// Orders are 32-bit floats: half a unit in the last place of 2 rad is 1.2e-7. So much off limits
// and speeds they are inside as floats as well.
constexpr double float_margin_rad = 1e-6;

// No-load speeds of HeadYaw and HeadPitch (velocity limits of the NAO's URDFs, V3.2 to V6).
constexpr HeadAngles greatest_speed_rad_s{8.26797, 7.19407};

HeadAngles allowed(HeadAngles angles) {
  return HeadLimits(float_margin_rad).clamp(angles);
}

}  // namespace

HeadAngles greatest_step() {
  constexpr double cycle_s = 1e-6 * static_cast<double>(lola_cycle_us);
  return {cycle_s * greatest_speed_rad_s.yaw_rad, cycle_s * greatest_speed_rad_s.pitch_rad};
}

void SetPoint::start(HeadAngles measured) {
  angles_ = allowed(measured);
}

// Pitch is clamped at the yaw it is told with. That may turn it where its way was straight, but no
// faster: the table's edges have slopes of at most 0.46, and yaw's greatest step is 1.15 of
// pitch's.
bool SetPoint::step(HeadAngles target, double speed_fraction, std::int64_t elapsed_us) {
  const double cycles =
      std::clamp(static_cast<double>(elapsed_us) / static_cast<double>(lola_cycle_us), 0.0, 1.0);
  const double share = std::clamp(speed_fraction, 0.0, 1.0) * cycles;
  const HeadAngles most{share * (greatest_step().yaw_rad - float_margin_rad),
                        share * (greatest_step().pitch_rad - float_margin_rad)};
  const HeadAngles way = allowed(target) - angles_;
  const double steps =
      std::max(std::abs(way.yaw_rad) / most.yaw_rad, std::abs(way.pitch_rad) / most.pitch_rad);
  if (steps > 1.0) {
    angles_ = allowed(angles_ + HeadAngles{way.yaw_rad / steps, way.pitch_rad / steps});
    return false;
  }
  if (share > 0.0) angles_ = allowed(target);
  return share > 0.0;
}

}  // namespace gazed
