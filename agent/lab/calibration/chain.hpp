// The kinematic chain and the lens for any number type, so that a solver can differentiate them.
// For doubles it gives what cam_from_torso() and pixel_of() give (a test compares them), with the
// neck as origin: where the neck stands in the torso no picture of an unmeasured thing can tell.
//
//   neck_from_cam = Rz(yaw) T(axis_offset) Ry(pitch) T(mount_offset) R(mount_rotation)
//   torso_axes_from_optical_axes,     joint angle = scale x sensor + zero
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "agent/lab/calibration/parameters.hpp"

namespace gazed::lab::calibration {

template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

template <class T>
struct CameraPlace {
  Matrix3<T> neck_from_cam;
  Vector3<T> centre_m;  // of the camera, from the neck
};

/// About y and about z, by an angle of any number type.
template <class T>
[[nodiscard]] Matrix3<T> turned_about_y(const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  Matrix3<T> r;
  r << c, T(0), s, T(0), T(1), T(0), -s, T(0), c;
  return r;
}
template <class T>
[[nodiscard]] Matrix3<T> turned_about_z(const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  Matrix3<T> r;
  r << c, -s, T(0), s, c, T(0), T(0), T(0), T(1);
  return r;
}
template <class T>
[[nodiscard]] Matrix3<T> turned_about_x(const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  Matrix3<T> r;
  r << T(1), T(0), T(0), T(0), c, -s, T(0), s, c;
  return r;
}

/// `parameters`: parameter_count numbers. `sensor`: yaw and pitch as the sensors say, rad.
template <class T>
[[nodiscard]] CameraPlace<T> camera_place(const T* parameters, const T* sensor) {
  const Eigen::Map<const Vector3<T>> offset(parameters + mount_offset_at);
  const Eigen::Map<const Vector3<T>> axis_offset(parameters + axis_offset_at);
  const T* rpy = parameters + mount_rotation_at;
  const T yaw = parameters[encoder_scale_at] * sensor[0] + parameters[zero_at];
  const T pitch = parameters[encoder_scale_at + 1] * sensor[1] + parameters[zero_at + 1];
  const Matrix3<T> yawed = turned_about_z(yaw);
  const Matrix3<T> pitched = turned_about_y(pitch);
  const Matrix3<T> mount = turned_about_z(rpy[2]) * turned_about_y(rpy[1]) * turned_about_x(rpy[0]);
  // Optical axes in the axes of the head: z forward is x, x right is -y, y down is -z.
  Matrix3<T> optical;
  optical << -mount.col(1), -mount.col(2), mount.col(0);
  return {yawed * (pitched * optical), yawed * (axis_offset + pitched * offset)};
}

/// The pixel of a direction in the optical frame, z positive.
template <class T>
[[nodiscard]] Vector2<T> seen_at(const T* parameters, const Vector3<T>& in_cam) {
  const T x = in_cam.x() / in_cam.z(), y = in_cam.y() / in_cam.z();
  const T s = x * x + y * y;
  const T* d = parameters + distortion_at;
  const T radial = T(1) + s * (d[0] + s * (d[1] + s * d[4]));
  const T dx = x * radial + T(2) * d[2] * x * y + d[3] * (s + T(2) * x * x);
  const T dy = y * radial + d[2] * (s + T(2) * y * y) + T(2) * d[3] * x * y;
  return {parameters[focal_at] * dx + parameters[centre_at],
          parameters[focal_at + 1] * dy + parameters[centre_at + 1]};
}

}  // namespace gazed::lab::calibration
