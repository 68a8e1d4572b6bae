#include "projection.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

namespace gazed {

Projection decompose(const Eigen::Matrix<double, 3, 4>& p) {
  // The rows in reverse order turn QR of the transpose into RQ.
  const Eigen::Matrix3d reversed{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  const Eigen::Matrix<double, 3, 4> signed_p = p.leftCols<3>().determinant() < 0.0 ? -p : p;
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr((reversed * signed_p.leftCols<3>()).transpose());
  const Eigen::Matrix3d r = qr.matrixQR().triangularView<Eigen::Upper>();
  Eigen::Matrix3d k = reversed * r.transpose() * reversed;
  const Eigen::Matrix3d signs = k.diagonal().cwiseSign().asDiagonal();
  k = (k * signs).eval();
  Projection out;
  out.cam_from_world.rotation = signs * reversed * Eigen::Matrix3d(qr.householderQ()).transpose();
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

Pose relative_pose(const Pose& cam1_from_world, const Pose& cam2_from_world) {
  return cam2_from_world * cam1_from_world.inverse();
}

}  // namespace gazed
