#include "agent/tracking/relief.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "agent/geometry/singular_values.hpp"

namespace gazed::tracking {

namespace {

// A disc tilted by 22 degrees is as round; if its outline is known only to a cell, half of that.
constexpr double axes_ratio_min = 0.93;
// Area relative to an ellipse with the same moments: 0.955 for a square, 0.83 for a triangle.
constexpr double filled_min = 0.97;

// Maps normalised coordinates to angles about the ray.
Eigen::Matrix2d angles_about(const Eigen::Vector2d& normalised) {
  const double length2 = normalised.squaredNorm(), secant2 = 1.0 + length2;
  Eigen::Matrix2d radial = Eigen::Matrix2d::Zero();
  if (length2 > 0.0) radial = normalised * normalised.transpose() / length2;
  return radial / secant2 + (Eigen::Matrix2d::Identity() - radial) / std::sqrt(secant2);
}

}  // namespace

Relief::Relief(const ObjectMask& object, const geometry::CameraModel& camera) : inside_(1.0) {
  const ObjectMask::Moments moments = object.moments();
  // The variance of an ellipse along a half axis is a quarter of that axis squared.
  const Eigen::Matrix2d axes_px2 = 4.0 * moments.covariance_px2;
  centre_px_ = moments.centroid_px;
  inverse_ = axes_px2.inverse();
  const Eigen::Vector2d by_px = camera.focal_px.cwiseInverse();
  const Eigen::Matrix2d angles =
      angles_about(by_px.cwiseProduct(centre_px_ - camera.centre_px)) * by_px.asDiagonal();
  Eigen::Matrix2d scaled = angles * axes_px2 * angles.transpose(), axes;
  const double area2 = scaled.determinant();
  geometry::decompose(scaled, axes);
  const double wide2 = scaled.col(0).norm(), narrow2 = scaled.col(1).norm();
  radius_rad_ = std::sin(std::atan(std::sqrt(std::sqrt(area2))));
  const double filled = moments.area_px2 / (std::numbers::pi * std::sqrt(axes_px2.determinant()));
  is_round_ =
      std::min(wide2, narrow2) > axes_ratio_min * axes_ratio_min * std::max(wide2, narrow2) &&
      filled > filled_min;
}

}  // namespace gazed::tracking
