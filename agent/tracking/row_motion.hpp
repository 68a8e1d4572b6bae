// What a rolling shutter does to the pixels while the head still creeps.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/view.hpp"

namespace gazed::tracking {

/// How the camera turned between the exposure of a pixel's row and that of the middle row. For
/// distant points and to first order: a sweep of 2 mrad moves an object at 0.3 m by another 0.2 px.
class RowMotion {
 public:
  RowMotion(const geometry::HeadGeometry& head, const geometry::View& view)
      : last_row_px_(view.image.height_px - 1), sigma_rad_(view.sweep_sigma_rad) {
    const Eigen::Matrix3d cam_axes = geometry::cam_from_torso(head, view.head).rotation;
    const Eigen::Vector3d pitch_axis =
        geometry::about_z(view.head.yaw_rad + head.zero.yaw_rad).col(1);
    turn_ = cam_axes *
            (view.sweep.yaw_rad * Eigen::Vector3d::UnitZ() + view.sweep.pitch_rad * pitch_axis);
  }

  /// Where a point seen at `normalised` in row `row_px` would have been seen if the whole frame had
  /// been exposed with its middle row. The scene turns against the camera.
  [[nodiscard]] Eigen::Vector2d undone(const Eigen::Vector2d& normalised, double row_px) const {
    const Eigen::Vector3d ray = normalised.homogeneous();
    return (ray - ray.cross(share(row_px) * turn_)).hnormalized();
  }
  /// Standard deviation of that correction, normalised coordinates.
  [[nodiscard]] double sigma(double row_px) const { return std::abs(share(row_px)) * sigma_rad_; }

 private:
  [[nodiscard]] double share(double row_px) const { return row_px / last_row_px_ - 0.5; }

  Eigen::Vector3d turn_;  // from the first row to the last, in the camera's axes
  double last_row_px_, sigma_rad_;
};

}  // namespace gazed::tracking
