#include "agent/geometry/pose.hpp"

#include <Eigen/Geometry>

namespace gazed::geometry {

Eigen::Matrix3d rotation_by(const Eigen::Vector3d& vector_rad) {
  const double angle = vector_rad.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector_rad / angle).toRotationMatrix();
}

Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  // Below it, rounding (1e-16) turns the sum's direction by more than a half turn is off.
  constexpr double opposite = 1e-8;
  const Eigen::Vector3d start = from.normalized(), sum = start + to.normalized();
  const Eigen::Vector3d middle = sum.norm() < opposite ? start.unitOrthogonal() : sum.normalized();
  const auto mirror = [](const Eigen::Vector3d& normal) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose();
  };
  return mirror(middle) * mirror(start);  // the first makes -start of start
}

}  // namespace gazed::geometry
