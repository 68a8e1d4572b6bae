// Robot profiles: what is known of each NAO version before anybody calibrates it (DESIGN 4.4,
// sources in NAO.md 1).
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
  HeadAngles max_speed_rad_s;  // no-load, NAO.md 1.3
};

[[nodiscard]] std::array<std::string_view, 4> robot_names();

/// None for a name that is not in robot_names().
[[nodiscard]] std::optional<RobotProfile> robot_profile(
    std::string_view name, CameraPosition position = CameraPosition::top);

}  // namespace gazed::geometry
