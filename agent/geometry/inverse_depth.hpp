// A point by its ray and its inverse depth: the form in which a point at infinity is a number, too.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace gazed::geometry {

/// A point on camera 1's ray through `direction` (normalised): X = (direction, 1) / inverse_depth.
/// Zero is at infinity, negative is behind camera 1.
struct InverseDepthPoint {
  Eigen::Vector2d direction;
  double inverse_depth_per_m = 0.0;

  [[nodiscard]] bool is_finite() const {
    return direction.allFinite() && std::isfinite(inverse_depth_per_m);
  }
  /// In camera 1's frame, metres. Not finite at infinity.
  [[nodiscard]] Eigen::Vector3d point_m() const {
    return direction.homogeneous() / inverse_depth_per_m;
  }
};

/// Not finite for a point beside camera 1's centre, at depth 0.
[[nodiscard]] inline InverseDepthPoint inverse_depth_point(const Eigen::Vector3d& point_m) {
  return {point_m.hnormalized(), 1.0 / point_m.z()};
}

}  // namespace gazed::geometry
