// Robot profiles: what is known of each NAO version before anybody calibrates it. Sources are in
// robot.cpp and in agent/geometry/README.md.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "agent/geometry/head.hpp"
#include "agent/geometry/rig.hpp"

namespace gazed::geometry {

enum class CameraPosition { top, bottom };

struct RobotProfile {
  std::string_view name;
  Rig rig;
  double readout_s = 0.0;      // rolling shutter: first row to last
  double delay_s = 0.0;        // added to the driver's time stamp to give the start of exposure
  HeadAngles max_speed_rad_s;  // no-load
};

[[nodiscard]] std::array<std::string_view, 4> robot_names();

/// None for a name that is not in robot_names().
[[nodiscard]] std::optional<RobotProfile> robot_profile(
    std::string_view name, CameraPosition position = CameraPosition::top);

}  // namespace gazed::geometry
