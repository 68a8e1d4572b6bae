// Triangulation by rectification: both views are turned to common axes, with the baseline along x,
// and the depth follows from the disparity (Fusiello, Trucco and Verri 2000; Russcher 2011, 3.1).
//
// All image points are normalised: on the plane z = 1, distortion undone.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::triangulation::methods {

/// Rotations from each camera's axes to those of the rectified views.
struct Rectification {
  Eigen::Matrix3d rectified_from_cam1, rectified_from_cam2;
  double baseline_m = 0.0;
};

/// None for a zero baseline, or one along camera 1's optical axis, which leaves the rectified views
/// no direction to look in.
[[nodiscard]] std::optional<Rectification> rectify(const geometry::Pose& cam2_from_cam1);

/// The point on camera 1's own ray that has the measured disparity. The rows, which differ if the
/// rays do not meet, are not used.
[[nodiscard]] geometry::InverseDepthPoint intersect_rectified(const Rectification& rectification,
                                                              const Eigen::Vector2d& point_1,
                                                              const Eigen::Vector2d& point_2);

/// d (rectified x of view 2) / d point_2.
[[nodiscard]] Eigen::RowVector2d rectified_gradient_2(const Rectification& rectification,
                                                      const Eigen::Vector2d& point_2);

}  // namespace gazed::triangulation::methods
