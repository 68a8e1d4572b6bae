#include "agent/triangulation/methods/linear_mmse.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace gazed::triangulation::methods {

namespace {

using Rows = Eigen::Matrix<double, 2, 3>;

/// The rows (u p3 - p1), (v p3 - p2) of one view times X equal `right`.
struct ViewRows {
  ViewRows(const geometry::Pose& cam_from_cam1, const Eigen::Vector2d& point)
      : left(point * cam_from_cam1.rotation.row(2) - cam_from_cam1.rotation.topRows<2>()),
        right(cam_from_cam1.translation.head<2>() - point * cam_from_cam1.translation.z()) {}

  Rows left;
  Eigen::Vector2d right;
};

/// W of a covariance C: W C W^T = I.
Eigen::Matrix2d whitening(const Eigen::Matrix2d& covariance) {
  constexpr double least_noise = 1e-9;
  const Eigen::Matrix2d l =
      (covariance + least_noise * least_noise * Eigen::Matrix2d::Identity()).llt().matrixL();
  return l.inverse();
}

double depth(const geometry::Pose& cam_from_cam1, const Eigen::Vector3d& point_m) {
  // A row without noise would outweigh everything else.
  constexpr double least_depth_m = 1e-6;
  return std::max(least_depth_m, std::abs((cam_from_cam1 * point_m).z()));
}

}  // namespace

std::optional<MmseEstimate> estimate_linear_mmse(const geometry::Pose& cam2_from_cam1,
                                                 const Eigen::Vector2d& point_1,
                                                 const Eigen::Vector2d& point_2,
                                                 const MmseModel& model) {
  const Prior& prior = model.prior;
  if (!(prior.sigma_m.array() > 0.0).all()) return std::nullopt;
  const ViewRows rows_1(geometry::Pose{}, point_1), rows_2(cam2_from_cam1, point_2);
  const Eigen::Matrix2d whitening_1 = whitening(model.noise_1),
                        whitening_2 = whitening(model.noise_2);
  const Eigen::Matrix3d prior_information_root = prior.sigma_m.cwiseInverse().asDiagonal();

  // The whitened stack of prior and rows: least squares by QR keeps the digits that the printed
  // form Cx - Ka S Ka^T loses (Cx is 1e9 times what is left of it).
  Eigen::Matrix<double, 7, 3> stack;
  Eigen::Matrix<double, 7, 1> right;
  Eigen::HouseholderQR<Eigen::Matrix<double, 7, 3>> qr;
  MmseEstimate out;
  out.point_m = prior.mean_m;
  for (int iteration = 0; iteration < 2; ++iteration) {
    const double depth_1_m = depth(geometry::Pose{}, out.point_m);
    const double depth_2_m = depth(cam2_from_cam1, out.point_m);
    stack << prior_information_root, whitening_1 * rows_1.left / depth_1_m,
        whitening_2 * rows_2.left / depth_2_m;
    right << prior.mean_m.cwiseQuotient(prior.sigma_m), whitening_1 * rows_1.right / depth_1_m,
        whitening_2 * rows_2.right / depth_2_m;
    qr.compute(stack);
    out.point_m = qr.solve(right);
  }
  const Eigen::Matrix3d inverse_root =
      qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>().solve(
          Eigen::Matrix3d::Identity().eval());
  out.covariance_m2 = inverse_root * inverse_root.transpose();
  // An error e of an image point changes what its rows leave over by -depth e: the depth cancels.
  Eigen::Matrix<double, 3, 4> by_rows;
  by_rows << -stack.middleRows<2>(3).transpose() * whitening_1,
      -stack.middleRows<2>(5).transpose() * whitening_2;
  out.by_image_points_m = out.covariance_m2 * by_rows;
  out.by_prior_m = out.covariance_m2 * prior_information_root;
  if (!out.point_m.allFinite() || !out.covariance_m2.allFinite() ||
      !out.by_image_points_m.allFinite()) {
    return std::nullopt;
  }
  return out;
}

}  // namespace gazed::triangulation::methods
