// The body of a NAO V6 as seen through LoLA, the robot's own process that reads the sensors and
// drives the motors 83 times a second (manufacturer's documentation 2.8, "LoLA").
//
// Vocabulary. A state is what LoLA sends, an order is what it receives. Both have a value for each
// of the 25 joints, in LoLA's order, which begins with the two of the head.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "agent/geometry/head.hpp"

namespace gazed::lola {

inline constexpr std::size_t joint_count = 25;
inline constexpr std::size_t head_yaw = 0;
inline constexpr std::size_t head_pitch = 1;
inline constexpr std::int64_t lola_cycle_us = 12'000;

/// nao_lola's lola_enums.hpp, after the "LoLA RoboCupper Official Documentation". There is no
/// RHipYawPitch: one motor turns both hips.
inline constexpr std::array<std::string_view, joint_count> joint_names{
    "HeadYaw",    "HeadPitch",   "LShoulderPitch", "LShoulderRoll",  "LElbowYaw",
    "LElbowRoll", "LWristYaw",   "LHipYawPitch",   "LHipRoll",       "LHipPitch",
    "LKneePitch", "LAnklePitch", "LAnkleRoll",     "RHipRoll",       "RHipPitch",
    "RKneePitch", "RAnklePitch", "RAnkleRoll",     "RShoulderPitch", "RShoulderRoll",
    "RElbowYaw",  "RElbowRoll",  "RWristYaw",      "LHand",          "RHand"};

struct LolaState {
  std::array<float, joint_count> position_rad{};  // hands: 0 closed to 1 open
  std::array<float, joint_count> stiffness{};     // [0, 1]; -1 also means off
  std::array<float, joint_count> temperature_c{};
  std::array<float, joint_count> current_a{};
  std::array<std::uint8_t, joint_count> temperature_status{};  // 0 normal to 3 critically hot
  std::array<float, 2> torso_rad{};                            // roll, pitch

  [[nodiscard]] geometry::HeadAngles head() const {
    return {static_cast<double>(position_rad[head_yaw]),
            static_cast<double>(position_rad[head_pitch])};
  }
};

struct LolaOrder {
  std::array<float, joint_count> position_rad{};
  std::array<float, joint_count> stiffness{};
};

}  // namespace gazed::lola
