#include "agent/geometry/head.hpp"

namespace gazed::geometry {

namespace {

// The head's axes (x forward, y left, z up) to optical axes (x right, y down, z forward): Russcher
// 2011, eq. 4.1.
Eigen::Matrix3d optical_from_head_axes() {
  return (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
}

}  // namespace

Pose cam_from_torso(const HeadGeometry& head, HeadAngles measured) {
  const HeadAngles joint = measured + head.zero;
  const Eigen::Vector3d& rpy = head.mount_rotation_rad;
  const Pose torso_from_head{rotation_z(joint.yaw_rad) * rotation_y(joint.pitch_rad),
                             head.neck_offset_m};
  const Pose head_from_cam{rotation_z(rpy.z()) * rotation_y(rpy.y()) * rotation_x(rpy.x()) *
                               optical_from_head_axes().transpose(),
                           head.mount_offset_m};
  return (torso_from_head * head_from_cam).inverse();
}

Pose cam2_from_cam1(const HeadGeometry& head, HeadAngles measured_1, HeadAngles measured_2) {
  return cam_from_torso(head, measured_2) * cam_from_torso(head, measured_1).inverse();
}

}  // namespace gazed::geometry
