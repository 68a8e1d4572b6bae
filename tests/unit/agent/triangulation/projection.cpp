#include "projection.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace gazed::triangulation {

Projection decompose(const Eigen::Matrix<double, 3, 4>& p) {
  const Eigen::Matrix<double, 3, 4> signed_p = p.leftCols<3>().determinant() < 0.0 ? -p : p;
  Eigen::Matrix3d k = Eigen::Matrix3d::Zero(), r = Eigen::Matrix3d::Zero();
  for (int i = 2; i >= 0; --i) {
    Eigen::Vector3d row = signed_p.block<1, 3>(i, 0).transpose();
    for (int j = 2; j > i; --j) {
      k(i, j) = r.row(j) * row;
      row -= k(i, j) * r.row(j).transpose();
    }
    k(i, i) = row.norm();
    r.row(i) = row.normalized().transpose();
  }
  Projection out;
  out.cam_from_world.rotation = r;
  out.cam_from_world.translation = k.inverse() * signed_p.col(3);
  out.k = k / k(2, 2);
  return out;
}

ImagePoint image_point(const Eigen::Matrix3d& k, const Eigen::Vector2d& pixel,
                       double pixel_sigma_px) {
  const Eigen::Vector2d normalised = (k.inverse() * pixel.homogeneous()).hnormalized();
  return {.normalised = normalised,
          .distorted = normalised,
          .pixel_jacobian = k.topLeftCorner<2, 2>(),
          .covariance_px2 = pixel_sigma_px * pixel_sigma_px * Eigen::Matrix2d::Identity()};
}

geometry::Pose relative_pose(const geometry::Pose& cam1_from_world,
                             const geometry::Pose& cam2_from_world) {
  return cam2_from_world * cam1_from_world.inverse();
}

}  // namespace gazed::triangulation
