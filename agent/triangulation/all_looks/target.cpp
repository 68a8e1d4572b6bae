#include "agent/triangulation/all_looks/target.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/cholesky.hpp"

namespace gazed::triangulation::all_looks {

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

/// A pixel's residual in a look, in standard deviations; zero if the look cannot see the target.
Eigen::Vector2d residual_of(const Problem& problem, const Robot& robot,
                            const geometry::InverseDepthPoint& target, std::size_t k) {
  PointInLook seen;
  if (!robot.see_at_target_row(k, target, seen)) return Eigen::Vector2d::Zero();
  return problem.target[k].whitening * (seen.pixel - problem.target[k].pixel);
}

/// How far an image point lies from where everything else predicts it. In a direction where nothing
/// else predicts it (only this look decides), residual and covariance are zero.
double innovation_chi2(const Eigen::Vector2d& residual, const Matrix& by_unknowns,
                       const Matrix& covariance) {
  constexpr double undecided = 1e-6;
  const Matrix half = by_unknowns.lazyProduct(covariance);
  const Eigen::Matrix2d known = half.lazyProduct(by_unknowns.transpose());
  const Eigen::Matrix2d of_residual = (1.0 + undecided) * Eigen::Matrix2d::Identity() - known;
  return residual.dot(of_residual.inverse() * residual);
}

/// Derivatives of the target in the torso frame by look 1's joints and the mount, metres.
Eigen::Matrix<double, 3, change_torso> torso_point_by_changes(const Robot& robot,
                                                              const geometry::Pose& torso_from_cam1,
                                                              const Vector3d& point_m) {
  const Matrix3d& axes = torso_from_cam1.rotation;
  const Vector3d from_neck = torso_from_cam1 * point_m - robot.head().neck_offset_m;
  const double yaw = robot.reading(0).yaw_rad + robot.head().zero.yaw_rad;
  Eigen::Matrix<double, 3, change_torso> out;
  out.setZero();
  out.col(change_reading) = Vector3d::UnitZ().cross(from_neck);
  out.col(change_reading + 1) = geometry::about_z(yaw).col(1).cross(from_neck);
  out.middleCols<3>(change_offset) = axes;
  for (int i = 0; i < 3; ++i) {
    out.col(change_rotation + i) = axes * Vector3d::Unit(i).cross(point_m);
  }
  return out;
}

}  // namespace

TargetAgreement target_agreement(const Problem& problem, const State& state, Solver& solver) {
  const Robot robot(problem, state.robot);
  const int unknowns = problem.robot_unknowns();
  const Matrix& covariance = solver.covariance();
  TargetAgreement out;
  // How what is known without the target pulls on the robot's unknowns.
  Vector pull = Vector::Zero(unknowns);
  int later_looks = 0;
  for (std::size_t k = 0; k < problem.looks; ++k) {
    if (!contains(problem.target_kept, k)) continue;
    const Eigen::Vector2d residual = residual_of(problem, robot, state.target, k);
    const Matrix by_unknowns = solver.target_row(k);
    pull += by_unknowns.leftCols(unknowns).transpose().lazyProduct(residual);
    out.chi2 += residual.squaredNorm();
    if (k == 0) continue;
    ++later_looks;
    const double chi2 = out.look_chi2[k] = innovation_chi2(residual, by_unknowns, covariance);
    if (chi2 > out.worst_chi2) {
      out.worst_chi2 = chi2;
      out.worst_look = k;
    }
  }
  Vector answer = pull;
  Matrix rest = solver.information_without_target();
  if (geometry::factorise(rest)) {
    geometry::solve_factorised(rest, answer);
    out.chi2 += pull.dot(answer);
  } else {
    out.chi2 = std::numeric_limits<double>::infinity();  // the prior was lost to rounding
  }
  out.degrees_of_freedom = 2 * later_looks - 1;
  if (later_looks < 2) {
    out.worst_look = 0;
    out.worst_chi2 = 0.0;
  }
  return out;
}

Propagated target_uncertainty(const Robot& robot, const State& state, const Matrix& covariance) {
  const geometry::InverseDepthPoint& target = state.target;
  const Matrix3d of_target = covariance.bottomRightCorner<3, 3>();
  Vector3d by_target;
  for (int i = 0; i < 3; ++i) by_target(i) = inverse_range_error(target, Vector3d::Unit(i));
  Propagated out;
  out.inverse_range_per_m = target.inverse_depth_per_m / target.direction.homogeneous().norm();
  out.inverse_range_sigma_per_m = std::sqrt(by_target.dot(of_target * by_target));
  if (!(target.inverse_depth_per_m > 0.0)) return out;

  const Vector3d point_m = target.point_m();
  Matrix3d point_by_target;
  point_by_target << Vector3d::UnitX(), Vector3d::UnitY(), -point_m;
  point_by_target /= target.inverse_depth_per_m;
  out.covariance_m2 = point_by_target * of_target * point_by_target.transpose();

  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(robot.head(), robot.reading(0)).inverse();
  const Matrix by_unknowns =
      robot.by_unknowns_of_look_1(torso_point_by_changes(robot, torso_from_cam1, point_m),
                                  torso_from_cam1.rotation * point_by_target);
  const Matrix half = by_unknowns.lazyProduct(covariance);
  out.torso_covariance_m2 = half.lazyProduct(by_unknowns.transpose());
  return out;
}

double baseline_sigma_m(const Robot& robot, std::size_t look, const Matrix& covariance) {
  const LookGeometry& geometry = robot.look(look);
  const Vector3d along = geometry.cam_from_cam1().translation.normalized();
  Eigen::Matrix<double, 1, robot_columns> by_robot =
      Eigen::Matrix<double, 1, robot_columns>::Zero();
  by_robot.head<pose_columns>() = along.transpose() * geometry.baseline_by_pose();
  Matrix raw = Matrix::Zero(1, robot.raw_columns() + 3);
  robot.add_raw(look, by_robot, raw.row(0).head(robot.raw_columns()));
  const Matrix by_unknowns = robot.by_unknowns(raw);
  const Matrix half = by_unknowns.lazyProduct(covariance);
  return std::sqrt(half.row(0).dot(by_unknowns.row(0)));
}

}  // namespace gazed::triangulation::all_looks
