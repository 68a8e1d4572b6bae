// What a calibration of the head estimates, as one list of numbers.
//
// Parameter: one number of the camera or of the head, in the order of the keys below. Prior: the
// value and the standard deviation it is believed to have before any picture; a standard deviation
// of 0 holds it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::lab::calibration {

/// Where each quantity starts in the list.
enum ParameterIndex : Eigen::Index {
  focal_at = 0,            // fx, fy, px
  centre_at = 2,           // cx, cy, px
  distortion_at = 4,       // k1, k2, p1, p2, k3
  mount_offset_at = 9,     // x, y, z, m
  mount_rotation_at = 12,  // roll, pitch, yaw, rad
  zero_at = 15,            // yaw, pitch, rad
  encoder_scale_at = 17,   // yaw, pitch: joint angle = scale x what the sensor says + zero
  axis_offset_at = 19,     // from the yaw axis to the pitch axis, x, y, z, m, turning with yaw
  parameter_count = 22,
};

using Parameters = Eigen::Matrix<double, parameter_count, 1>;

struct ParameterName {
  std::string_view text;  // the TOML key and the element; a plain name where there is no key
  std::string_view unit;
};
[[nodiscard]] const std::array<ParameterName, parameter_count>& parameter_names();

/// A camera in a head whose encoders may count wrongly and whose two axes may not meet.
struct HeadModel {
  geometry::CameraModel camera;
  geometry::HeadGeometry head;
  Eigen::Vector2d encoder_scale = Eigen::Vector2d::Ones();  // yaw, pitch
  Eigen::Vector3d axis_offset_m = Eigen::Vector3d::Zero();  // the NAO's axes meet: 0
};

[[nodiscard]] Parameters parameters_of(const HeadModel& model);
/// `model` with the numbers of the list.
[[nodiscard]] HeadModel with_parameters(HeadModel model, const Parameters& p);

struct Prior {
  Parameters mean = Parameters::Zero();
  Parameters sigma = Parameters::Zero();

  /// The parameters that are not held, ascending.
  [[nodiscard]] std::vector<int> free_indices() const;
  [[nodiscard]] std::vector<int> held_indices() const;
};

}  // namespace gazed::lab::calibration
