#include "agent/triangulation/methods/linear_mmse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "agent/geometry/cholesky.hpp"

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

Eigen::Matrix2d whitening_of_noise(Eigen::Matrix2d covariance) {
  constexpr double least_noise = 1e-9;
  covariance.diagonal().array() += least_noise * least_noise;
  return geometry::whitening(covariance);
}

/// Least squares of seven equations for a point: the columns of the three unknowns, then the right
/// side.
using Column = Eigen::Matrix<double, 7, 1>;
using Equations = std::array<Column, 4>;

/// The triangle of the QR decomposition, with the right side as its last column, by the modified
/// Gram-Schmidt method. With the right side among the columns it is as accurate as Householder's
/// (Bjorck 1967).
Eigen::Matrix<double, 3, 4> triangle_of(Equations& equations) {
  Eigen::Matrix<double, 3, 4> out = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    Column& own = equations[k];
    out(row, row) = own.norm();
    own /= out(row, row);
    for (std::size_t j = k + 1; j < 4; ++j) {
      const double share = own.dot(equations[j]);
      out(row, static_cast<Eigen::Index>(j)) = share;
      equations[j] -= share * own;
    }
  }
  return out;
}

/// Solves R x = right, where R is the first three columns of `triangle`.
Eigen::Vector3d solved(const Eigen::Matrix<double, 3, 4>& triangle, Eigen::Vector3d right) {
  for (Eigen::Index i = 3; i-- > 0;) {
    for (Eigen::Index j = i + 1; j < 3; ++j) right(i) -= triangle(i, j) * right(j);
    right(i) /= triangle(i, i);
  }
  return right;
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
  const Eigen::Matrix2d whitening_1 = whitening_of_noise(model.noise_1),
                        whitening_2 = whitening_of_noise(model.noise_2);
  const Eigen::Vector3d prior_information_root = prior.sigma_m.cwiseInverse();

  // The whitened stack of prior and rows: least squares by QR keeps the digits that the printed
  // form Cx - Ka S Ka^T loses to cancellation (Cx is 1e9 times the result).
  Rows weighted_1, weighted_2;
  Eigen::Matrix<double, 3, 4> triangle;
  MmseEstimate out;
  out.point_m = prior.mean_m;
  for (int iteration = 0; iteration < 2; ++iteration) {
    const double depth_1_m = depth(geometry::Pose{}, out.point_m);
    const double depth_2_m = depth(cam2_from_cam1, out.point_m);
    weighted_1 = whitening_1 * rows_1.left / depth_1_m;
    weighted_2 = whitening_2 * rows_2.left / depth_2_m;
    Equations equations;
    for (Eigen::Index j = 0; j < 3; ++j) {
      equations[static_cast<std::size_t>(j)]
          << prior_information_root(j) * Eigen::Vector3d::Unit(j),
          weighted_1.col(j), weighted_2.col(j);
    }
    equations[3] << prior.mean_m.cwiseQuotient(prior.sigma_m),
        whitening_1 * rows_1.right / depth_1_m, whitening_2 * rows_2.right / depth_2_m;
    triangle = triangle_of(equations);
    out.point_m = solved(triangle, triangle.col(3));
  }
  Eigen::Matrix3d inverse_root;
  for (Eigen::Index j = 0; j < 3; ++j) {
    inverse_root.col(j) = solved(triangle, Eigen::Vector3d::Unit(j));
  }
  out.covariance_m2 = inverse_root * inverse_root.transpose();
  // An error e of an image point changes the residual of its rows by -depth e: the depth cancels.
  out.by_image_points_m << -out.covariance_m2 * (weighted_1.transpose() * whitening_1),
      -out.covariance_m2 * (weighted_2.transpose() * whitening_2);
  out.by_prior_m = out.covariance_m2 * prior_information_root.asDiagonal();
  if (!out.point_m.allFinite() || !out.covariance_m2.allFinite() ||
      !out.by_image_points_m.allFinite()) {
    return std::nullopt;
  }
  return out;
}

}  // namespace gazed::triangulation::methods
