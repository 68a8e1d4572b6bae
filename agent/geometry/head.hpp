// Head kinematics: where the camera is for given joint angles.
//
// Frames. torso: x forward, y left, z up, origin of the manufacturer's torso frame. head: turns
// with both joints, same axes as the torso at (0, 0), origin where the two joint axes meet. cam:
// the optical frame, x right, y down, z forward, origin at the camera's centre of projection.
// Angles. HeadYaw is positive to the left (about +z), HeadPitch positive downward (about +y).
// Radians.
//
// Chain (Russcher 2011: eq. 4.1 holds, eq. 4.2 is corrected, see agent/geometry/README.md):
//   torso_from_cam = T(neck_offset) Rz(yaw) Ry(pitch) T(mount_offset) R(mount_rotation)
//   torso_axes_from_optical_axes
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "agent/geometry/pose.hpp"

namespace gazed::geometry {

struct HeadAngles {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;

  friend bool operator==(const HeadAngles&, const HeadAngles&) = default;
};

[[nodiscard]] inline HeadAngles operator+(HeadAngles a, HeadAngles b) {
  return {a.yaw_rad + b.yaw_rad, a.pitch_rad + b.pitch_rad};
}
[[nodiscard]] inline HeadAngles operator-(HeadAngles a, HeadAngles b) {
  return {a.yaw_rad - b.yaw_rad, a.pitch_rad - b.pitch_rad};
}

[[nodiscard]] inline bool finite(HeadAngles angles) {
  return std::isfinite(angles.yaw_rad) && std::isfinite(angles.pitch_rad);
}

/// The greater of both axes' differences, without sign.
[[nodiscard]] inline double greatest_difference(HeadAngles a, HeadAngles b) {
  return std::max(std::abs(a.yaw_rad - b.yaw_rad), std::abs(a.pitch_rad - b.pitch_rad));
}

/// What is rigid in a head. Metres and radians.
struct HeadGeometry {
  Eigen::Vector3d neck_offset_m =
      Eigen::Vector3d::Zero();  // torso origin to joint axes, torso frame
  Eigen::Vector3d mount_offset_m = Eigen::Vector3d::Zero();  // joint axes to camera, head frame
  Eigen::Vector3d mount_rotation_rad =
      Eigen::Vector3d::Zero();  // roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll)
  HeadAngles zero;              // added to what the sensor says
};

/// The pose that maps torso coordinates to the camera's optical frame, for the angles that the
/// sensor says.
[[nodiscard]] Pose cam_from_torso(const HeadGeometry& head, HeadAngles measured);

/// The relative pose of two looks: x2 = R x1 + t. The identity when both angles are the same.
[[nodiscard]] Pose cam2_from_cam1(const HeadGeometry& head, HeadAngles measured_1,
                                  HeadAngles measured_2);

}  // namespace gazed::geometry
