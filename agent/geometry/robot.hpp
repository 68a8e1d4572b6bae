// Robot profiles: what is known of each NAO version before anybody calibrates it. Sources are in
// robot.cpp and in agent/geometry/README.md.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::geometry {

enum class CameraPosition { top, bottom };

/// Standard deviations of everything that is measured or was calibrated; each holds for every axis
/// it applies to.
struct Uncertainty {
  double pixel_sigma_px =
      0.0;  // of an image point, per axis, on top of the registration's own covariance
  double encoder_sigma_rad = 0.0;         // of a joint angle, per axis and look
  double zero_sigma_rad = 0.0;            // of a joint's zero: the same error in all looks
  double focal_sigma_px = 0.0;            // one error for fx and fy together
  double centre_sigma_px = 0.0;           // of the principal point, per axis
  double mount_offset_sigma_m = 0.0;      // of the camera's position in the head, per axis
  double mount_rotation_sigma_rad = 0.0;  // of the camera's orientation in the head, per axis
};

/// Those of an Uncertainty that somebody states; the others keep what they have.
struct UncertaintyOverride {
  std::optional<double> pixel_sigma_px = std::nullopt;
  std::optional<double> encoder_sigma_rad = std::nullopt;
  std::optional<double> zero_sigma_rad = std::nullopt;
  std::optional<double> focal_sigma_px = std::nullopt;
  std::optional<double> centre_sigma_px = std::nullopt;
  std::optional<double> mount_offset_sigma_m = std::nullopt;
  std::optional<double> mount_rotation_sigma_rad = std::nullopt;
};

struct RobotProfile {
  std::string_view name;
  CameraModel camera;
  HeadGeometry head;
  Uncertainty uncertainty;
  double readout_s = 0.0;      // rolling shutter: first row to last
  double delay_s = 0.0;        // added to the driver's time stamp to give the start of exposure
  HeadAngles max_speed_rad_s;  // no-load
};

[[nodiscard]] std::array<std::string_view, 4> robot_names();

/// None for a name that is not in robot_names().
[[nodiscard]] std::optional<RobotProfile> robot_profile(
    std::string_view name, CameraPosition position = CameraPosition::top);

}  // namespace gazed::geometry
