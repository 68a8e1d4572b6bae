// The methods of ALMotion that gazed calls (QiLoop, idl/v5/motion.qi.idl: a scan of a robot), and
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

/// One number per joint of the head, in the joints' order.
using PerJoint = std::array<float, 2>;

inline void write_joints(QiWriter& arguments) {
  arguments.dynamic_list(head_joints);
}
inline void write_joints(QiWriter& arguments, const PerJoint& values) {
  write_joints(arguments);
  arguments.dynamic_list(values);
}

/// None unless the answer consists of two numbers.
[[nodiscard]] inline std::optional<PerJoint> per_joint(const QiResult& result) {
  QiReader numbers = result.value.elements();
  const auto yaw = numbers.next().number();
  const auto pitch = numbers.next().number();
  if (!yaw || !pitch || numbers.next()) return std::nullopt;
  return PerJoint{static_cast<float>(*yaw), static_cast<float>(*pitch)};
}

/// The answer of getLimits() for one joint, [[min, max, speed, effort]]; none if it is not a valid
/// range.
[[nodiscard]] std::optional<geometry::AngleRange> limits_in(const QiResult& result);

/// The "Model Type" in the answer of getRobotConfig(), [[name...], [value...]]: "naoH25" or
/// "naoH21" for a NAO (Aldebaran documentation 2.1, "ALMotion"); empty if missing.
[[nodiscard]] std::string model_in(const QiResult& result);
/// False for another robot's model, such as Pepper's "juliette". A robot that does not report its
/// model may be a NAO.
[[nodiscard]] bool may_be_nao(std::string_view model);

/// Arguments of setAngles(). Both angles are rounded to 32-bit reals towards zero, and the pitch is
/// clamped again at the rounded yaw, so that angles inside HeadLimits stay inside.
void write_set_angles(QiWriter& arguments, geometry::HeadAngles target, double speed_fraction);

/// Describes why a call failed.
[[nodiscard]] std::string trouble_of(MotionMethod method, const QiResult& result);

}  // namespace gazed::naoqi
