// The methods of ALMotion that gazed uses (QiLoop, idl/v5/motion.qi.idl: a scan of a robot), and
// their arguments.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "agent/geometry/limits.hpp"
#include "drivers/naoqi/service.hpp"

namespace gazed::naoqi {

enum MotionMethod : std::size_t {
  get_angles,
  set_angles,
  get_stiffnesses,
  set_stiffnesses,
  get_limits,
  get_breathing,
  set_breathing,
  get_idle_posture,
  set_idle_posture,
  get_robot_config,
};

inline constexpr std::array<QiMethod, 10> motion_methods{{{"getAngles", "(mb)"},
                                                          {"setAngles", "(mmf)"},
                                                          {"getStiffnesses", "(m)"},
                                                          {"setStiffnesses", "(mm)"},
                                                          {"getLimits", "(s)", false},
                                                          {"getBreathEnabled", "(s)", false},
                                                          {"setBreathEnabled", "(sb)", false},
                                                          {"getIdlePostureEnabled", "(s)", false},
                                                          {"setIdlePostureEnabled", "(sb)", false},
                                                          {"getRobotConfig", "()", false}}};

inline constexpr std::array<std::string_view, 2> head_joints{"HeadYaw", "HeadPitch"};

/// One number for each joint of the head, in their order.
using PerJoint = std::array<float, 2>;

inline void write_joints(QiWriter& arguments) {
  arguments.dynamic_list(head_joints);
}
inline void write_joints(QiWriter& arguments, const PerJoint& values) {
  write_joints(arguments);
  arguments.dynamic_list(values);
}

/// None unless the answer is two numbers.
[[nodiscard]] inline std::optional<PerJoint> per_joint(const QiResult& result) {
  QiReader numbers = result.value.elements();
  const auto yaw = numbers.next().number();
  const auto pitch = numbers.next().number();
  if (!yaw || !pitch || numbers.next()) return std::nullopt;
  return PerJoint{static_cast<float>(*yaw), static_cast<float>(*pitch)};
}

/// getLimits() of one joint, [[min, max, speed, effort]]: none for what is no range.
[[nodiscard]] std::optional<geometry::AngleRange> limits_in(const QiResult& result);

/// getRobotConfig(), [[name...], [value...]]: the "Model Type", "naoH25" or "naoH21" of a NAO
/// (Aldebaran documentation 2.1, "ALMotion"); empty where there is none.
[[nodiscard]] std::string model_in(const QiResult& result);
/// False for the model of another robot, as "juliette" is Pepper's; a robot that does not say its
/// model may be one.
[[nodiscard]] bool may_be_nao(std::string_view model);

/// setAngles(). As reals of 32 bits both angles are rounded towards zero, and the pitch is clamped
/// once more at the rounded yaw: what was inside HeadLimits still is.
void write_set_angles(QiWriter& arguments, geometry::HeadAngles target, double speed_fraction);

/// What went wrong with a call, in words.
[[nodiscard]] std::string trouble_of(MotionMethod method, const QiResult& result);

}  // namespace gazed::naoqi
