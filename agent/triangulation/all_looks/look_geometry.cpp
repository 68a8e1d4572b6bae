#include "agent/triangulation/all_looks/look_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "agent/geometry/chain.hpp"

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using PoseChange = Eigen::Matrix<double, pose_columns, 1>;

constexpr double least_depth = 0.05;

Matrix3d cross_matrix(const Vector3d& v) {
  return Matrix3d{{0.0, -v.z(), v.y()}, {v.z(), 0.0, -v.x()}, {-v.y(), v.x(), 0.0}};
}

/// The scene turns about an axis through a point `from_place_m` in front of the camera's centre;
/// both in camera axes.
PoseChange turn(const Vector3d& axis, const Vector3d& from_place_m) {
  PoseChange out;
  out << axis, axis.cross(from_place_m);
  return out;
}

/// The derivatives by the camera's parameters.
void fill_camera(const geometry::CameraModel& camera, const Eigen::Vector2d& normalised,
                 PointInLook& out) {
  const double radius_2 = normalised.squaredNorm();
  out.by_robot.col(column_focal) = (out.pixel - camera.centre_px).cwiseQuotient(camera.focal_px);
  out.by_robot.middleCols<2>(column_centre).setIdentity();
  out.by_robot.col(column_distortion) = radius_2 * camera.focal_px.cwiseProduct(normalised);
  out.by_robot.col(column_distortion + 1) = radius_2 * out.by_robot.col(column_distortion);
}

}  // namespace

CameraMount::CameraMount(const geometry::HeadGeometry& head) {
  // The head with both joints at 0 and its neck at the torso's origin.
  const geometry::Pose pose =
      geometry::cam_from_torso({.neck_offset_m = Vector3d::Zero(),
                                .mount_offset_m = head.mount_offset_m,
                                .mount_rotation_rad = head.mount_rotation_rad,
                                .zero = {}},
                               {});
  cam_from_head = pose.rotation;
  arm_m = -pose.translation;
}

HeadTurn::HeadTurn(geometry::HeadAngles joint)
    : torso_from_head(geometry::about_z(joint.yaw_rad) * geometry::about_y(joint.pitch_rad)) {}

// With the torso's axes at the neck, C the rotation from them to the camera and c the arm, a point
// x1 of look 1 is p = C1^T (x1 + c) there. After the torso has moved it is T p - d, and in this
// camera C (T p - d) - c. So x = A x1 + t with A = C T C1^T and t = A c - C d - c.
LookGeometry::LookGeometry(const CameraMount& mount, const HeadTurn& turn_1, const HeadTurn& turn,
                           const TorsoMotion& torso)
    : arm_m_(mount.arm_m), pitch_axis_(mount.cam_from_head.col(1)) {
  const Matrix3d cam_from_torso = mount.cam_from_head * turn.torso_from_head.transpose();
  const Matrix3d torso_from_cam1 = turn_1.torso_from_head * mount.cam_from_head.transpose();
  rotation_ = cam_from_torso * geometry::rotation_by(-torso.rotation_rad) * torso_from_cam1;
  translation_m_ = rotation_ * arm_m_ - cam_from_torso * torso.translation_m - arm_m_;
  yaw_axis_ = cam_from_torso.col(2);
}

bool LookGeometry::see(const geometry::CameraModel& camera,
                       const geometry::InverseDepthPoint& point, const RowTurn& row,
                       const Eigen::Matrix<double, 3, 2>& axes, PointInLook& out) const {
  const double w = point.inverse_depth_per_m;
  const Vector3d at_target_row = rotation_ * point.direction.homogeneous() + w * translation_m_;
  const Vector3d from_neck = at_target_row + w * row.arm_m;
  const Vector3d here = at_target_row + row.turn_rad.cross(from_neck);
  if (!(here.z() > least_depth)) return false;
  const Eigen::Vector2d normalised = here.hnormalized();
  if (!geometry::invertible_within(camera, normalised.norm())) return false;
  const Eigen::Matrix2d by_normalised = geometry::pixel_jacobian(camera, normalised) / here.z();
  out.pixel = geometry::pixel_of(camera, normalised);
  for (int i = 0; i < 2; ++i) {
    Vector3d by_here;  // of this coordinate
    by_here << by_normalised.row(i).transpose(), -by_normalised.row(i).dot(normalised);
    const Vector3d by_turn = from_neck.cross(by_here);
    // with respect to at_target_row
    const Vector3d gradient = by_here - row.turn_rad.cross(by_here);
    const Vector3d gradient_1 = rotation_.transpose() * gradient;  // with respect to look 1's ray
    out.by_point.row(i) << gradient_1.x(), gradient_1.y(),
        gradient.dot(translation_m_) + by_here.dot(row.turn_rad.cross(row.arm_m));
    out.by_robot.row(i).segment<3>(column_pose) = at_target_row.cross(gradient);
    out.by_robot.row(i).segment<3>(column_pose + 3) = w * gradient;
    out.by_robot.row(i).segment<2>(column_sweep) = by_turn.transpose() * axes;
  }
  fill_camera(camera, normalised, out);
  return true;
}

Eigen::Matrix<double, 3, 2> LookGeometry::joint_axes() const {
  Eigen::Matrix<double, 3, 2> out;
  out << -yaw_axis_, -pitch_axis_;
  return out;
}

Eigen::Matrix<double, 3, pose_columns> LookGeometry::baseline_by_pose() const {
  Eigen::Matrix<double, 3, pose_columns> out;
  out << -cross_matrix(translation_m_), Matrix3d::Identity();
  return out;
}

PoseChanges LookGeometry::pose_changes(const CameraMount& mount, const HeadTurn& turn_1,
                                       const HeadTurn& turn_k, const TorsoMotion& torso) const {
  const Matrix3d cam_from_torso = mount.cam_from_head * turn_k.torso_from_head.transpose();
  const Matrix3d cam_from_torso1 = cam_from_torso * geometry::rotation_by(-torso.rotation_rad);
  // From the neck at look 1, which has moved with the torso, and back.
  const Vector3d from_neck_1_m = arm_m_ + cam_from_torso * torso.translation_m;
  const Vector3d pitch_axis_1 = turn_1.torso_from_head.col(1);  // in the torso frame
  PoseChanges out = PoseChanges::Zero();
  out.col(change_reading) = turn(-yaw_axis_, arm_m_);
  out.col(change_reading + 1) = turn(-pitch_axis_, arm_m_);
  out.col(change_reading_1) = turn(cam_from_torso1.col(2), from_neck_1_m);
  out.col(change_reading_1 + 1) = turn(cam_from_torso1 * pitch_axis_1, from_neck_1_m);
  out.block<3, 3>(3, change_offset) = rotation_ - Matrix3d::Identity();
  out.block<3, 3>(0, change_rotation) = rotation_ - Matrix3d::Identity();
  out.block<3, 3>(3, change_rotation) = cross_matrix(translation_m_) * rotation_;
  // A change of a rotation vector turns by the left Jacobian of SO(3) times that change (Sola,
  // Deray and Atchuthan 2018, equation 145), to second order.
  const Matrix3d cross = cross_matrix(-torso.rotation_rad);
  const Matrix3d jacobian = Matrix3d::Identity() + 0.5 * cross + cross * cross / 6.0;
  const Matrix3d turns = -cam_from_torso * jacobian;
  for (int i = 0; i < 3; ++i) out.col(change_torso + i) = turn(turns.col(i), from_neck_1_m);
  out.block<3, 3>(3, change_torso + 3) = -cam_from_torso;
  return out;
}

bool see_in_look_1(const geometry::CameraModel& camera, const geometry::InverseDepthPoint& point,
                   PointInLook& out) {
  if (!geometry::invertible_within(camera, point.direction.norm())) return false;
  out.pixel = geometry::pixel_of(camera, point.direction);
  out.by_point << geometry::pixel_jacobian(camera, point.direction), Eigen::Vector2d::Zero();
  out.by_robot.setZero();
  fill_camera(camera, point.direction, out);
  return true;
}

}  // namespace gazed::triangulation::all_looks
