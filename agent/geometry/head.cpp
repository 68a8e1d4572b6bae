#include "agent/geometry/head.hpp"

#include "agent/geometry/chain.hpp"

namespace gazed::geometry {

Pose cam_from_torso(const HeadGeometry& head, HeadAngles measured) {
  const HeadAngles joint = measured + head.zero;
  const CameraPlace<double> place =
      camera_place(joint.yaw_rad, joint.pitch_rad,
                   Mount<double>{.axis_offset_m = Eigen::Vector3d::Zero(),
                                 .offset_m = head.mount_offset_m,
                                 .rotation_rad = head.mount_rotation_rad});
  const Pose torso_from_cam{place.neck_from_cam, place.centre_m + head.neck_offset_m};
  return torso_from_cam.inverse();
}

Pose cam2_from_cam1(const HeadGeometry& head, HeadAngles measured_1, HeadAngles measured_2) {
  return cam_from_torso(head, measured_2) * cam_from_torso(head, measured_1).inverse();
}

}  // namespace gazed::geometry
