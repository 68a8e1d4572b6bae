#include "agent/lab/analysis/estimator.hpp"

#include "agent/geometry/singular_values.hpp"
#include "agent/triangulation/methods/method.hpp"
#include "agent/triangulation/methods/optimal.hpp"

namespace gazed::lab::analysis {

namespace {

std::optional<Eigen::Vector3d> reconstruct_by(triangulation::methods::Method method,
                                              const Belief& belief) {
  triangulation::methods::MmseModel mmse;
  constexpr double pixel_sigma_px = 0.12;  // table 3.2: of the linear MMSE's own noise model
  const Eigen::Vector2d sigma = pixel_sigma_px * belief.focal_px.cwiseInverse();
  mmse.noise_1 = mmse.noise_2 = sigma.cwiseAbs2().asDiagonal();
  const auto solution = triangulation::methods::solve(method, belief.cam2_from_cam1,
                                                      belief.normalised(belief.pixel_1),
                                                      belief.normalised(belief.pixel_2), mmse);
  if (!solution || !solution->point_m().allFinite()) return std::nullopt;
  return solution->point_m();
}

std::optional<Eigen::Vector3d> reconstruct_replica(const Belief& belief, const Belief& truth) {
  const auto pair = triangulation::methods::correct_optimally(
      belief.cam2_from_cam1, belief.normalised(belief.pixel_1), belief.normalised(belief.pixel_2));
  if (!pair) return std::nullopt;
  return triangulate_linearly(truth.cam2_from_cam1, truth.normalised(belief.pixel(pair->point_1)),
                              truth.normalised(belief.pixel(pair->point_2)));
}

}  // namespace

std::string_view name(Estimator estimator) {
  switch (estimator) {
    case Estimator::optimal:
      return triangulation::methods::name(triangulation::methods::Method::optimal);
    case Estimator::rectification:
      return triangulation::methods::name(triangulation::methods::Method::rectification);
    case Estimator::linear_mmse:
      return triangulation::methods::name(triangulation::methods::Method::linear_mmse);
    case Estimator::replica:
      break;
  }
  return "replica";
}

std::optional<Eigen::Vector3d> reconstruct(Estimator estimator, const Belief& belief,
                                           const Belief& truth) {
  switch (estimator) {
    case Estimator::optimal:
      return reconstruct_by(triangulation::methods::Method::optimal, belief);
    case Estimator::rectification:
      return reconstruct_by(triangulation::methods::Method::rectification, belief);
    case Estimator::linear_mmse:
      return reconstruct_by(triangulation::methods::Method::linear_mmse, belief);
    case Estimator::replica:
      break;
  }
  return reconstruct_replica(belief, truth);
}

std::optional<Eigen::Vector3d> triangulate_linearly(const geometry::Pose& cam2_from_cam1,
                                                    const Eigen::Vector2d& point_1,
                                                    const Eigen::Vector2d& point_2) {
  Eigen::Matrix<double, 3, 4> p_1, p_2;
  p_1 << Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero();
  p_2 << cam2_from_cam1.rotation, cam2_from_cam1.translation;
  Eigen::Matrix4d rows;
  rows << point_1 * p_1.row(2) - p_1.topRows<2>(), point_2 * p_2.row(2) - p_2.topRows<2>();
  rows.rowwise().normalize();
  Eigen::Matrix4d v;
  geometry::decompose(rows, v);
  const Eigen::Vector4d null_vector = v.col(0);  // of the least singular value
  const Eigen::Vector3d point_m = null_vector.head<3>() / null_vector.w();
  if (!point_m.allFinite()) return std::nullopt;
  return point_m;
}

}  // namespace gazed::lab::analysis
