#include "drivers/lola/state_check.hpp"

#include <algorithm>
#include <cmath>

#include "agent/base/text.hpp"
#include "agent/geometry/limits.hpp"

namespace gazed::lola {

namespace {

// No joint of a NAO turns farther than 2.12 rad (the knee; manufacturer's documentation, "Joints"),
// and an uncalibrated encoder is at most half a turn off.
constexpr float farthest_rad = 3.15F;
constexpr float stiffest = 1.01F;  // 1, rounded as a float
// A joint that was held and is this far off was released meanwhile: ordering it back would make it
// strike out. 20 degrees, a choice: more than a stiff joint yields under its load.
constexpr float out_of_place_rad = 0.35F;
// A joint this much softer than it was held was released meanwhile: stiffening it at once would
// jerk a body that lies or hangs. A choice, far above the rounding of floats and percentages.
constexpr float softened = 0.1F;
// Tolerance for a body at rest: 3 degrees, a choice; a standing robot sways less.
constexpr float rests_within_rad = 0.05F;
// A choice, far above an encoder's error (a step is 0.0015 rad) and a wrongly set zero.
constexpr double beyond_limits_rad = 0.1;
// No motor of a running robot is frozen or boiling: 0 in a packet is a missing value. Only the
// head's motors are checked; a broken sensor in another joint does not matter here.
constexpr float coldest_c = 1.0F;
constexpr float hottest_c = 130.0F;

std::string_view name(std::size_t joint) {
  return joint_names[joint];
}

double outside(geometry::AngleRange range, double angle_rad) {
  return std::max(range.min_rad - angle_rad, angle_rad - range.max_rad);
}

std::string implausible_head(const LolaState& state) {
  const geometry::HeadLimits limits;
  const geometry::HeadAngles head = state.head();
  if (outside(limits.yaw_range(), head.yaw_rad) > beyond_limits_rad ||
      outside(limits.pitch_range(0.0), head.pitch_rad) > beyond_limits_rad)
    return base::text("the head is said to be at (%g, %g) rad, beyond its joints' limits",
                      head.yaw_rad, head.pitch_rad);
  for (const std::size_t i : {head_yaw, head_pitch}) {
    const float temperature_c = state.temperature_c[i];
    if (!(temperature_c >= coldest_c && temperature_c <= hottest_c))
      return base::text("%s is said to have %g C", name(i).data(),
                        static_cast<double>(temperature_c));
  }
  return {};
}

}  // namespace

std::string implausible(const LolaState& state) {
  for (std::size_t i = 0; i < joint_count; ++i) {
    const float position_rad = state.position_rad[i], stiffness = state.stiffness[i];
    if (!(std::abs(position_rad) <= farthest_rad))
      return base::text("%s is said to be at %g rad", name(i).data(),
                        static_cast<double>(position_rad));
    if (!(std::abs(stiffness) <= stiffest))
      return base::text("%s is said to have stiffness %g", name(i).data(),
                        static_cast<double>(stiffness));
  }
  const auto [roll, pitch] = state.torso_rad;
  if (!std::isfinite(roll) || !std::isfinite(pitch))
    return base::text("the torso is said to lean by (%g, %g) rad", static_cast<double>(roll),
                      static_cast<double>(pitch));
  return implausible_head(state);
}

double torso_tilt_rad(const LolaState& state) {
  const double roll = static_cast<double>(state.torso_rad[0]);
  const double pitch = static_cast<double>(state.torso_rad[1]);
  return std::acos(std::clamp(std::cos(roll) * std::cos(pitch), -1.0, 1.0));
}

std::string changed_since(const LolaState& before, const LolaState& state) {
  for (std::size_t i = 0; i < joint_count; ++i) {
    if (std::abs(state.position_rad[i] - before.position_rad[i]) > rests_within_rad)
      return base::text("%s moves, from %.2f to %.2f rad", name(i).data(),
                        static_cast<double>(before.position_rad[i]),
                        static_cast<double>(state.position_rad[i]));
    if (state.stiffness[i] != before.stiffness[i])
      return base::text("%s changes its stiffness from %.2f to %.2f", name(i).data(),
                        static_cast<double>(before.stiffness[i]),
                        static_cast<double>(state.stiffness[i]));
  }
  return {};
}

std::string out_of_place(const LolaState& state, const LolaOrder& held) {
  for (std::size_t i = 0; i < joint_count; ++i) {
    if (i == head_yaw || i == head_pitch || !(held.stiffness[i] > 0.0F)) continue;
    const float position_rad = state.position_rad[i];
    if (std::abs(position_rad - held.position_rad[i]) > out_of_place_rad)
      return base::text(
          "%s is at %.2f rad, and was at %.2f when it was first held: start gazed anew",
          name(i).data(), static_cast<double>(position_rad),
          static_cast<double>(held.position_rad[i]));
    if (state.stiffness[i] < held.stiffness[i] - softened)
      return base::text("%s has lost its stiffness meanwhile, %.2f of %.2f: start gazed anew",
                        name(i).data(), static_cast<double>(state.stiffness[i]),
                        static_cast<double>(held.stiffness[i]));
  }
  return {};
}

}  // namespace gazed::lola
