#include "drivers/lola/state_check.hpp"

#include <algorithm>
#include <cmath>

#include "agent/text.hpp"

namespace gazed {

namespace {

// No joint of a NAO turns farther than 2.12 rad (the knee; joint page of the manufacturer's
// documentation, "Joints"), and an encoder that was never calibrated is half a turn off at most.
constexpr float farthest_rad = 3.15F;
constexpr float stiffest = 1.01F;  // 1, and what a float makes of it
// A joint that was held and is so far off was let go in between: told to be back at once it would
// strike out. 20 degrees; a stiff joint under load gives way by less than 5.
constexpr float out_of_place_rad = 0.35F;

std::string_view name(std::size_t joint) {
  return joint_names[joint];
}

}  // namespace

std::string implausible(const LolaState& state) {
  for (std::size_t i = 0; i < joint_count; ++i) {
    const float position_rad = state.position_rad[i], stiffness = state.stiffness[i];
    if (!(std::abs(position_rad) <= farthest_rad))
      return text("%s is said to be at %g rad", name(i).data(), static_cast<double>(position_rad));
    if (!(std::abs(stiffness) <= stiffest))
      return text("%s is said to have stiffness %g", name(i).data(),
                  static_cast<double>(stiffness));
  }
  const auto [roll, pitch] = state.torso_rad;
  if (!std::isfinite(roll) || !std::isfinite(pitch))
    return text("the torso is said to lean by (%g, %g) rad", static_cast<double>(roll),
                static_cast<double>(pitch));
  return {};
}

double torso_tilt_rad(const LolaState& state) {
  const double roll = static_cast<double>(state.torso_rad[0]);
  const double pitch = static_cast<double>(state.torso_rad[1]);
  return std::acos(std::clamp(std::cos(roll) * std::cos(pitch), -1.0, 1.0));
}

std::string out_of_place(const LolaState& state, const LolaOrder& held) {
  for (std::size_t i = 0; i < joint_count; ++i) {
    if (i == head_yaw || i == head_pitch || !(held.stiffness[i] > 0.0F)) continue;
    const float position_rad = state.position_rad[i];
    if (std::abs(position_rad - held.position_rad[i]) > out_of_place_rad)
      return text("%s is at %.2f rad, and was at %.2f when it was first held: start gazed anew",
                  name(i).data(), static_cast<double>(position_rad),
                  static_cast<double>(held.position_rad[i]));
  }
  return {};
}

}  // namespace gazed
