// The robot's calibration and its uncertainty: as configured before the looks, and as estimated
// from them afterwards.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/rig.hpp"

namespace gazed::triangulation::all_looks {

struct BelievedRobot {
  geometry::CameraModel camera;
  geometry::HeadGeometry head;  // including the joint zeros
  // Standard deviations.
  double focal_sigma_px = 0.0;  // one error for both axes
  Eigen::Vector2d centre_sigma_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d distortion_sigma = Eigen::Vector2d::Zero();  // k1, k2
  Eigen::Vector3d mount_rotation_sigma_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d mount_offset_sigma_m = Eigen::Vector3d::Zero();
  Eigen::Vector2d zero_sigma_rad = Eigen::Vector2d::Zero();  // yaw, pitch
};

/// The configured calibration of a rig, before any look.
[[nodiscard]] BelievedRobot believed_before(const geometry::Rig& rig);

}  // namespace gazed::triangulation::all_looks
