#include "agent/triangulation/all_looks/look_geometry.hpp"

#include <Eigen/Geometry>

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr double least_depth = 0.05;

Matrix3d cross_matrix(const Vector3d& v) {
  return Matrix3d{{0.0, -v.z(), v.y()}, {v.z(), 0.0, -v.x()}, {-v.y(), v.x(), 0.0}};
}

/// The part of the derivatives that is the camera's alone.
void fill_camera(const geometry::CameraModel& camera, const Eigen::Vector2d& normalised,
                 PointInLook& out) {
  const double radius_2 = normalised.squaredNorm();
  out.by_head.col(column_distortion) = radius_2 * camera.focal_px.cwiseProduct(normalised);
  out.by_head.col(column_distortion + 1) = radius_2 * out.by_head.col(column_distortion);
  out.by_head.col(column_focal) = (out.pixel - camera.centre_px).cwiseQuotient(camera.focal_px);
  out.by_head.middleCols<2>(column_centre).setIdentity();
  out.by_head.middleCols<2>(column_sweep).setZero();
}

}  // namespace

CameraMount::CameraMount(const geometry::HeadGeometry& head) {
  // The head at rest, its neck at the torso's origin.
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
    : torso_from_head(geometry::rotation_z(joint.yaw_rad) * geometry::rotation_y(joint.pitch_rad)) {
}

// With head_from_head1 = G, head_from_cam axes = M and the arm c in camera axes, a point r/w (its
// depth 1/w) of look 1 is at x/w here: x = M^T G M (r + w c) - w c = A r + w (A c - c).
LookGeometry::LookGeometry(const CameraMount& mount, const HeadTurn& turn_1, const HeadTurn& turn)
    : arm_m_(mount.arm_m), pitch_axis_(mount.cam_from_head.col(1)) {
  const Matrix3d head_from_head1 = turn.torso_from_head.transpose() * turn_1.torso_from_head;
  const Matrix3d cam_from_head1 = mount.cam_from_head * head_from_head1;
  rotation_ = cam_from_head1 * mount.cam_from_head.transpose();
  translation_m_ = rotation_ * arm_m_ - arm_m_;
  yaw_axis_ = mount.cam_from_head * turn.torso_from_head.row(2).transpose();
  pitch_1_axis_ = cam_from_head1.col(1);
}

LookGeometry LookGeometry::turned_by(geometry::HeadAngles angles) const {
  // The scene turns the other way: x becomes x + x x turn.
  const Vector3d turn = angles.yaw_rad * yaw_axis_ + angles.pitch_rad * pitch_axis_;
  LookGeometry out = *this;
  for (int i = 0; i < 3; ++i) out.rotation_.col(i) += rotation_.col(i).cross(turn);
  out.translation_m_ = out.rotation_ * arm_m_ - arm_m_;
  out.yaw_axis_ += angles.pitch_rad * yaw_axis_.cross(pitch_axis_);
  out.pitch_1_axis_ += pitch_1_axis_.cross(turn);
  return out;
}

bool LookGeometry::see(const geometry::CameraModel& camera,
                       const geometry::InverseDepthPoint& point, PointInLook& out) const {
  const Vector3d ray = point.direction.homogeneous();
  const double w = point.inverse_depth_per_m;
  const Vector3d here = rotation_ * ray + w * translation_m_;
  if (!(here.z() > least_depth)) return false;
  const Vector3d from_neck = here + w * arm_m_;
  const Eigen::Vector2d normalised = here.hnormalized();
  if (!geometry::invertible_within(camera, normalised.norm())) return false;
  const Eigen::Matrix2d by_normalised = geometry::pixel_jacobian(camera, normalised) / here.z();
  out.pixel = geometry::pixel_of(camera, normalised);
  fill_camera(camera, normalised, out);
  for (int i = 0; i < 2; ++i) {
    Vector3d gradient;  // of this coordinate, by `here`
    gradient << by_normalised.row(i).transpose(), -by_normalised.row(i).dot(normalised);
    const Vector3d gradient_1 = rotation_.transpose() * gradient;
    const Vector3d turned = from_neck.cross(gradient);
    out.by_point(i, 0) = gradient_1.x();
    out.by_point(i, 1) = gradient_1.y();
    out.by_point(i, 2) = gradient.dot(translation_m_);
    out.by_head(i, column_yaw) = -yaw_axis_.dot(turned);
    out.by_head(i, column_pitch) = -pitch_axis_.dot(turned);
    out.by_head(i, column_pitch_1) = pitch_1_axis_.dot(turned);
    out.by_head.row(i).segment<3>(column_offset) = w * (gradient_1 - gradient);
    out.by_head.row(i).segment<3>(column_rotation) = ray.cross(gradient_1) - here.cross(gradient);
  }
  return true;
}

Baseline LookGeometry::baseline() const {
  Baseline out{translation_m_, Eigen::Matrix<double, 3, head_columns>::Zero()};
  const Vector3d from_neck = translation_m_ + arm_m_;
  out.by_head.col(column_yaw) = -yaw_axis_.cross(from_neck);
  out.by_head.col(column_pitch) = -pitch_axis_.cross(from_neck);
  out.by_head.col(column_pitch_1) = pitch_1_axis_.cross(from_neck);
  out.by_head.middleCols<3>(column_offset) = rotation_ - Matrix3d::Identity();
  out.by_head.middleCols<3>(column_rotation) = cross_matrix(translation_m_);
  return out;
}

bool see_in_look_1(const geometry::CameraModel& camera, const geometry::InverseDepthPoint& point,
                   PointInLook& out) {
  if (!geometry::invertible_within(camera, point.direction.norm())) return false;
  out.pixel = geometry::pixel_of(camera, point.direction);
  out.by_point << geometry::pixel_jacobian(camera, point.direction), Eigen::Vector2d::Zero();
  out.by_head.setZero();
  fill_camera(camera, point.direction, out);
  return true;
}

}  // namespace gazed::triangulation::all_looks
