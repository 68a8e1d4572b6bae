// The chain of the head and the lens as functions of the list of parameters, for any number type,
// so that a solver can differentiate them; the neck is the origin: where the neck stands in the
// torso no picture of an unmeasured thing can tell. Joint angle = scale x sensor + zero.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/lens.hpp"
#include "agent/lab/calibration/parameters.hpp"

namespace gazed::lab::calibration {

using geometry::CameraPlace;
using geometry::Vector3;
template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

/// `parameters`: parameter_count numbers. `sensor`: yaw and pitch as the sensors say, rad.
template <class T>
[[nodiscard]] CameraPlace<T> camera_place(const T* parameters, const T* sensor) {
  const auto three_at = [parameters](int at) -> Vector3<T> {
    return {parameters[at], parameters[at + 1], parameters[at + 2]};
  };
  const T yaw = parameters[encoder_scale_at] * sensor[0] + parameters[zero_at];
  const T pitch = parameters[encoder_scale_at + 1] * sensor[1] + parameters[zero_at + 1];
  return geometry::camera_place(yaw, pitch,
                                geometry::Mount<T>{.axis_offset_m = three_at(axis_offset_at),
                                                   .offset_m = three_at(mount_offset_at),
                                                   .rotation_rad = three_at(mount_rotation_at)});
}

/// The pixel of a direction in the optical frame, z positive.
template <class T>
[[nodiscard]] Vector2<T> seen_at(const T* parameters, const Vector3<T>& in_cam) {
  const Vector2<T> normalised(in_cam.x() / in_cam.z(), in_cam.y() / in_cam.z());
  const Vector2<T> seen = geometry::distorted(parameters + distortion_at, normalised);
  return {parameters[focal_at] * seen.x() + parameters[centre_at],
          parameters[focal_at + 1] * seen.y() + parameters[centre_at + 1]};
}

}  // namespace gazed::lab::calibration
