// Robot profiles: what is known of each NAO version before anybody calibrates it. Sources are in
// robot.cpp and in agent/geometry/README.md.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "agent/geometry/head.hpp"
#include "agent/geometry/rig.hpp"

namespace gazed::geometry {

enum class CameraPosition { top, bottom };

inline constexpr std::array<std::string_view, 4> robot_names{"nao-v3", "nao-v4", "nao-v5",
                                                             "nao-v6"};

/// How Linux has one of the robot's cameras, and what its driver must be told.
struct VideoProfile {
  std::string_view device;            // "/dev/video-top"
  std::optional<bool> upside_down{};  // as it is built in; none: nothing is known of its flips
  bool has_auto_focus = false;        // a lens that moves changes the focal length
  bool flips_by_extension_unit = false;
};

struct RobotProfile {
  std::string_view name;
  Rig rig;
  double readout_s = 0.0;      // rolling shutter: first row to last
  double delay_s = 0.0;        // added to the driver's time stamp to give the start of exposure
  HeadAngles max_speed_rad_s;  // no-load
  // Standard deviations, of each joint: how far from its command it comes to rest, and how its
  // gear's play adds to that.
  double settling_sigma_rad = 0.0;
  double play_sigma_rad = 0.0;
  VideoProfile video;

  /// What a move must be longer by than it is to be: three of those sigmas.
  [[nodiscard]] double move_margin_rad() const {
    return 3.0 * std::hypot(settling_sigma_rad, play_sigma_rad);
  }
};

/// None for a name that is not one of robot_names.
[[nodiscard]] std::optional<RobotProfile> robot_profile(
    std::string_view name, CameraPosition position = CameraPosition::top);

}  // namespace gazed::geometry
