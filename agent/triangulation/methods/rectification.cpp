#include "agent/triangulation/methods/rectification.hpp"

#include <Eigen/Geometry>

namespace gazed::triangulation::methods {

std::optional<Rectification> rectify(const geometry::Pose& cam2_from_cam1) {
  // If the baseline is this close to the optical axis (radians), its perpendicular is only
  // rounding.
  constexpr double least_angle = 1e-9;
  const Eigen::Vector3d centre_2_m = geometry::origin(cam2_from_cam1);
  const double baseline_m = centre_2_m.norm();
  if (!(baseline_m > 0.0)) return std::nullopt;
  const Eigen::Vector3d x = centre_2_m / baseline_m;
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(x);
  const double sine = across.norm();
  if (!(sine > least_angle)) return std::nullopt;
  const Eigen::Vector3d y = across / sine;
  Rectification out;
  out.rectified_from_cam1 << x.transpose(), y.transpose(), x.cross(y).transpose();
  out.rectified_from_cam2 = out.rectified_from_cam1 * cam2_from_cam1.rotation.transpose();
  out.baseline_m = baseline_m;
  return out;
}

geometry::InverseDepthPoint intersect_rectified(const Rectification& rectification,
                                                const Eigen::Vector2d& point_1,
                                                const Eigen::Vector2d& point_2) {
  const Eigen::Vector3d ray_1 = rectification.rectified_from_cam1 * point_1.homogeneous();
  const Eigen::Vector3d ray_2 = rectification.rectified_from_cam2 * point_2.homogeneous();
  // Rectified depth = baseline / disparity, and `ray_1.z()` converts it from camera 1's own depth.
  // Multiplied out, so that view 1 may look along the rectified image plane.
  return {point_1, (ray_1.x() - ray_1.z() * (ray_2.x() / ray_2.z())) / rectification.baseline_m};
}

Eigen::RowVector2d rectified_gradient_2(const Rectification& rectification,
                                        const Eigen::Vector2d& point_2) {
  const Eigen::Matrix3d& axes = rectification.rectified_from_cam2;
  const Eigen::Vector3d ray = axes * point_2.homogeneous();
  return (axes.row(0).head<2>() - ray.x() / ray.z() * axes.row(2).head<2>()) / ray.z();
}

}  // namespace gazed::triangulation::methods
