// The head's kinematic chain for any number type: doubles give head.hpp its poses, and a solver
// that differentiates automatically gives its own.
//
//   neck_from_cam = Rz(yaw) T(axis_offset) Ry(pitch) T(mount_offset) R(mount_rotation)
//   torso_axes_from_optical_axes
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace gazed::geometry {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

/// Right-handed rotations about the axes, angles in radians.
template <class T>
[[nodiscard]] Matrix3<T> about_x(const T& angle_rad) {
  using std::cos;
  using std::sin;
  const T c = cos(angle_rad), s = sin(angle_rad);
  Matrix3<T> r;
  r << T(1), T(0), T(0), T(0), c, -s, T(0), s, c;
  return r;
}
template <class T>
[[nodiscard]] Matrix3<T> about_y(const T& angle_rad) {
  using std::cos;
  using std::sin;
  const T c = cos(angle_rad), s = sin(angle_rad);
  Matrix3<T> r;
  r << c, T(0), s, T(0), T(1), T(0), -s, T(0), c;
  return r;
}
template <class T>
[[nodiscard]] Matrix3<T> about_z(const T& angle_rad) {
  using std::cos;
  using std::sin;
  const T c = cos(angle_rad), s = sin(angle_rad);
  Matrix3<T> r;
  r << c, -s, T(0), s, c, T(0), T(0), T(0), T(1);
  return r;
}

/// What is rigid between the joints and the camera, metres and radians.
template <class T>
struct Mount {
  Vector3<T> axis_offset_m;  // yaw's axis to pitch's, where they do not meet; turns with yaw
  Vector3<T> offset_m;       // pitch's axis to the camera, head frame
  Vector3<T> rotation_rad;   // roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll)
};

template <class T>
struct CameraPlace {
  Matrix3<T> neck_from_cam;
  Vector3<T> centre_m;  // of the camera, from the neck
};

template <class T>
[[nodiscard]] CameraPlace<T> camera_place(const T& yaw_rad, const T& pitch_rad,
                                          const Mount<T>& mount) {
  const Vector3<T>& rpy = mount.rotation_rad;
  const Matrix3<T> mounted = about_z(rpy.z()) * about_y(rpy.y()) * about_x(rpy.x());
  // z forward is x, x right is -y, y down is -z: Russcher 2011, eq. 4.1, the other way round.
  Matrix3<T> head_axes_from_optical_axes;
  head_axes_from_optical_axes << T(0), T(0), T(1), T(-1), T(0), T(0), T(0), T(-1), T(0);
  const Matrix3<T> head_from_cam = mounted * head_axes_from_optical_axes;
  const Matrix3<T> yawed = about_z(yaw_rad);
  const Matrix3<T> turned = yawed * about_y(pitch_rad);
  const Vector3<T> between_axes_m = yawed * mount.axis_offset_m;
  const Vector3<T> to_camera_m = turned * mount.offset_m;
  return {turned * head_from_cam, to_camera_m + between_axes_m};
}

}  // namespace gazed::geometry
