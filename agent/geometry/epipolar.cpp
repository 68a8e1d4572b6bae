#include "agent/geometry/epipolar.hpp"

#include <Eigen/LU>
#include <cmath>

namespace gazed::geometry {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

Eigen::Matrix3d essential_matrix(const Pose& cam2_from_cam1) {
  return skew(cam2_from_cam1.translation) * cam2_from_cam1.rotation;
}

std::optional<Eigen::Matrix3d> fundamental_matrix(const Eigen::Matrix3d& k1,
                                                  const Eigen::Matrix3d& k2,
                                                  const Pose& cam2_from_cam1) {
  // Two looks with the same angles still differ by the rounding of their poses, about 1e-17 m.
  constexpr double least_baseline_m = 1e-12;
  if (!(cam2_from_cam1.translation.norm() > least_baseline_m)) return std::nullopt;
  if (!k1.fullPivLu().isInvertible() || !k2.fullPivLu().isInvertible()) return std::nullopt;
  const Eigen::Matrix3d f =
      k2.inverse().transpose() * essential_matrix(cam2_from_cam1) * k1.inverse();
  const double norm = f.norm();
  if (!std::isfinite(norm) || norm == 0.0) return std::nullopt;
  return f / norm;
}

}  // namespace gazed::geometry
