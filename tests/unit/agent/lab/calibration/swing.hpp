// How far a thing that stands still seems to move when only the head moves.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::lab::calibration {

struct Robot {
  geometry::CameraModel camera;
  geometry::HeadGeometry head;
};

/// What a robot knows of a look: the angles its sensors say and the pixel of the thing.
struct Glance {
  geometry::HeadAngles measured;
  geometry::Pixel pixel = geometry::Pixel::Zero();
  double true_range_m = 0.0;  // from the camera
};

/// At every angle of a grid over the joints' limits that shows the point, what the true robot sees;
/// sensors and pixels err with these standard deviations.
[[nodiscard]] std::vector<Glance> glances_at(const Robot& truth,
                                             const Eigen::Vector3d& point_in_torso,
                                             double encoder_sigma_rad, double pixel_sigma_px);

/// The greatest distance between two of the points.
[[nodiscard]] double swing_m(const std::vector<Eigen::Vector3d>& points);

/// Where the believed robot puts the point from each glance and its true range: the direction only.
[[nodiscard]] std::vector<Eigen::Vector3d> points_by_direction(const Robot& believed,
                                                               const std::vector<Glance>& glances);

/// Where it puts the point from each two glances that lie a step of the report's rule (0.1 rad or
/// more on both axes, 0.2 at most) apart: where the rays come nearest to each other.
[[nodiscard]] std::vector<Eigen::Vector3d> points_by_two_looks(const Robot& believed,
                                                               const std::vector<Glance>& glances);

}  // namespace gazed::lab::calibration
