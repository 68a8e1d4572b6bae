#include "agent/tracking/prediction.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace gazed::tracking {

std::optional<Prediction> Prediction::make(const geometry::CameraModel& camera,
                                           const geometry::Pose& cam2_from_cam1,
                                           const Eigen::Vector2d& normalised_1,
                                           double inverse_depth_max_per_m, double margin_px) {
  constexpr double draw_back = 0.8;
  constexpr int draw_backs_max = 20;  // down to 1 % of the inverse depth
  const Eigen::Vector3d ray = cam2_from_cam1.rotation * normalised_1.homogeneous();
  const auto far_px = geometry::project(camera, ray);
  if (!far_px || !camera.contains(*far_px, -margin_px)) return std::nullopt;
  Prediction prediction;
  prediction.far_px_ = prediction.near_px_ = *far_px;
  prediction.far_z_ = prediction.near_z_ = ray.z();
  double inverse_depth = inverse_depth_max_per_m;
  for (int i = 0; i < draw_backs_max; ++i, inverse_depth *= draw_back) {
    const Eigen::Vector3d near_ray = ray + inverse_depth * cam2_from_cam1.translation;
    const auto near_px = geometry::project(camera, near_ray);
    if (!near_px || !camera.contains(*near_px, -margin_px)) continue;
    prediction.near_px_ = *near_px;
    prediction.near_z_ = near_ray.z();
    prediction.inverse_depth_max_per_m_ = inverse_depth;
    break;
  }
  return prediction;
}

// Solves share = lambda z_near / (lambda_max z(lambda)), where z is linear from z_far to z_near.
double Prediction::inverse_depth_at(double share) const {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * inverse_depth_max_per_m_ * far_z_ / (near_z_ - s * (near_z_ - far_z_));
}

Eigen::Matrix2d pixel_2_by_pixel_1(const geometry::CameraModel& camera,
                                   const geometry::Pose& cam2_from_cam1,
                                   const Eigen::Vector2d& normalised_1,
                                   double inverse_depth_per_m) {
  const Eigen::Vector3d ray = cam2_from_cam1.rotation * normalised_1.homogeneous() +
                              inverse_depth_per_m * cam2_from_cam1.translation;
  const Eigen::Vector2d normalised_2 = ray.hnormalized();
  Eigen::Matrix<double, 2, 3> by_ray;
  by_ray << 1.0, 0.0, -normalised_2.x(), 0.0, 1.0, -normalised_2.y();
  const Eigen::Matrix2d by_normalised = by_ray * cam2_from_cam1.rotation.leftCols<2>() / ray.z();
  return geometry::pixel_jacobian(camera, normalised_2) * by_normalised *
         geometry::pixel_jacobian(camera, normalised_1).inverse();
}

}  // namespace gazed::tracking
