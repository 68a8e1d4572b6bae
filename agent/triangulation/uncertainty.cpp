#include "agent/triangulation/uncertainty.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace gazed::triangulation {

Linearisation::Linearisation(const geometry::Pose& cam2_from_cam1,
                             const geometry::InverseDepthPoint& solution)
    : rotated_(cam2_from_cam1.rotation * solution.direction.homogeneous()),
      inverse_depth_(solution.inverse_depth_per_m) {
  const Eigen::Vector3d& t = cam2_from_cam1.translation;
  const Eigen::Vector3d point_2 = rotated_ + inverse_depth_ * t;
  view_2_ = point_2.hnormalized();
  projection_ << 1, 0, -view_2_.x(), 0, 1, -view_2_.y();
  projection_ /= point_2.z();
  by_direction_ = projection_ * cam2_from_cam1.rotation.leftCols<2>();
  by_inverse_depth_ = projection_ * t;
  // The direction across the surface is orthogonal to both kinds of derivative.
  const Eigen::Vector2d across_2(-by_inverse_depth_.y(), by_inverse_depth_.x());
  across_ << -by_direction_.transpose() * across_2, across_2;
  across_.normalize();
}

Response Linearisation::along_ray_1(const Eigen::RowVector2d& gradient_2) const {
  const Eigen::RowVector2d by_point_2 = gradient_2 / gradient_2.dot(by_inverse_depth_);
  Response out;
  out.by_image_points << Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero(),
      -by_point_2 * by_direction_, by_point_2;
  return out;
}

Response Linearisation::optimal() const {
  // On the surface all methods agree; off it, project first.
  Response out = along_ray_1(by_inverse_depth_.transpose());
  out.by_image_points -= (out.by_image_points * across_).eval() * across_.transpose();
  return out;
}

Eigen::Vector4d Linearisation::image_error(const ErrorSource& source) const {
  // If the pose is assumed to have changed, view 2 is predicted elsewhere; an opposite error of the
  // image point would have the same effect.
  const PoseChange& pose = source.cam2_from_cam1;
  Eigen::Vector4d error;
  error << source.normalised_1,
      source.normalised_2 -
          projection_ * (pose.rotation_rad.cross(rotated_) + inverse_depth_ * pose.translation_m);
  return error;
}

SolutionError Linearisation::error(const Response& response, const ErrorSource& source) const {
  const Eigen::Vector4d image = image_error(source);
  return {response.by_image_points * image, across(image)};
}

double inverse_range_error(const geometry::InverseDepthPoint& solution,
                           const Eigen::Vector3d& solution_error) {
  const Eigen::Vector2d& direction = solution.direction;
  const double ray_length_2 = direction.squaredNorm() + 1.0;
  return (solution_error.z() -
          solution.inverse_depth_per_m * direction.dot(solution_error.head<2>()) / ray_length_2) /
         std::sqrt(ray_length_2);
}

CovarianceSum::CovarianceSum(const geometry::InverseDepthPoint& solution,
                             const std::optional<geometry::Pose>& torso_from_cam1)
    : solution_(solution),
      ray_(solution.direction.homogeneous()),
      ray_length_(ray_.norm()),
      torso_(torso_from_cam1) {
  if (torso_) torso_offset_m_ = torso_->rotation * solution.point_m();
}

void CovarianceSum::add(const Eigen::Vector3d& solution_error,
                        const PoseChange& torso_from_cam1_change) {
  const double range_error = inverse_range_error(solution_, solution_error);
  inverse_range_variance_ += range_error * range_error;
  const double inverse_depth = solution_.inverse_depth_per_m;
  if (!(inverse_depth > 0.0)) return;
  const Eigen::Vector3d ray_error(solution_error.x(), solution_error.y(), 0.0);
  const Eigen::Vector3d point_error =
      (ray_error - ray_ * (solution_error.z() / inverse_depth)) / inverse_depth;
  covariance_ += point_error * point_error.transpose();
  if (!torso_) return;
  const Eigen::Vector3d torso_error = torso_->rotation * point_error +
                                      torso_from_cam1_change.rotation_rad.cross(torso_offset_m_) +
                                      torso_from_cam1_change.translation_m;
  torso_covariance_ += torso_error * torso_error.transpose();
}

Propagated CovarianceSum::result() const {
  Propagated out;
  out.inverse_range_per_m = solution_.inverse_depth_per_m / ray_length_;
  out.inverse_range_sigma_per_m = std::sqrt(inverse_range_variance_);
  if (solution_.inverse_depth_per_m > 0.0) {
    out.covariance_m2 = covariance_;
    if (torso_) out.torso_covariance_m2 = torso_covariance_;
  }
  return out;
}

Propagated propagate(const TwoViews& views, const ErrorSources& sources, const Solution& solution) {
  const auto& [point, linearisation, response] = solution;
  CovarianceSum sum(point, views.torso_from_cam1);
  double residual_variance = 0.0;
  const auto add = [&](const ErrorSource& source) {
    const SolutionError error = linearisation.error(response, source);
    residual_variance += error.residual * error.residual;
    sum.add(error.solution, source.torso_from_cam1);
  };
  for (const ErrorSource& source : image_noise(views)) add(source);
  for (const ErrorSource& source : sources.all()) add(source);
  if (!response.by_prior.isZero(0.0)) {
    for (int k = 0; k < 3; ++k) sum.add(response.by_prior.col(k), {});
  }
  Propagated out = sum.result();
  Eigen::Vector4d residual;
  residual << views.point_1.normalised - point.direction,
      views.point_2.normalised - linearisation.view_2();
  out.residual = linearisation.across(residual);
  out.residual_sigma = std::sqrt(residual_variance);
  return out;
}

}  // namespace gazed::triangulation
