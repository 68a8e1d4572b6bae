// What estimates are made from and held against, in more than one test.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/robot.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::triangulation {

/// What is filled under each status, apart from the numbers' values.
enum class Filled { nothing, residual, inverse_range, position };

void expect_filled(const PointEstimate& estimate, Filled filled);

/// A NAO V6 as delivered, well calibrated, that looks at a point from two sides.
struct Fixture {
  geometry::RobotProfile robot = geometry::robot_profile("nao-v6").value();
  Gate gate;
  TwoLooks looks;

  explicit Fixture(const Eigen::Vector3d& torso_point_m = {0.35, 0.02, 0.15},
                   geometry::HeadAngles head_1 = {0.2, 0.1},
                   geometry::HeadAngles head_2 = {-0.3, 0.3}) {
    robot.uncertainty = {.pixel_sigma_px = 0.3,
                         .encoder_sigma_rad = 1e-3,
                         .zero_sigma_rad = 3e-3,
                         .focal_sigma_px = 0.5,
                         .centre_sigma_px = 1.0,
                         .mount_offset_sigma_m = 1e-3,
                         .mount_rotation_sigma_rad = 3e-3};
    looks.head_1 = head_1;
    looks.head_2 = head_2;
    looks.pixel_1 = geometry::project(robot.camera,
                                      geometry::cam_from_torso(robot.head, head_1) * torso_point_m)
                        .value();
    looks.pixel_2 = geometry::project(robot.camera,
                                      geometry::cam_from_torso(robot.head, head_2) * torso_point_m)
                        .value();
  }

  [[nodiscard]] PointEstimate estimate() const {
    return estimate_point(robot.head, robot.camera, robot.uncertainty, looks, gate);
  }
};

}  // namespace gazed::triangulation
