#include "agent/triangulation/all_looks/solver.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/geometry/cholesky.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// Residuals beyond this many standard deviations count by their length, not its square.
constexpr double huber_sigmas = 1.5;
/// Levenberg and Marquardt's damping, of the information's diagonal.
constexpr double least_damping = 1e-8;
constexpr double damping_growth = 10.0;
constexpr double hopeless_damping = 1e9;
constexpr int iterations_max = 100;
/// Costs this close are the same.
constexpr double cost_rounding = 1e-9;

/// The squared step, in standard deviations, after which nothing moves: each step is at least
/// hundreds of times shorter than the one before. Huber's solution is but a start.
double decrement_max(Loss loss) {
  return loss == Loss::huber ? 1.0 : 1e-8;
}

struct Weighted {
  double cost, weight;
};
Weighted weigh(Loss loss, double chi2) {
  constexpr double limit = huber_sigmas * huber_sigmas;
  if (loss == Loss::squares || chi2 <= limit) return {chi2, 1.0};
  const double sigmas = std::sqrt(chi2);
  return {2.0 * huber_sigmas * sigmas - limit, huber_sigmas / sigmas};
}

}  // namespace

void RobotRows::start() {
  size_ = 0;
  camera_.setZero();
}

// Look 1's pose is that of the frame: its sweep alone.
void RobotRows::add(std::size_t look, const Eigen::Matrix<double, robot_columns, 3>& by_robot) {
  const int first = look == 0 ? column_sweep : column_pose, count = look_columns - first;
  rows_.middleRows(size_, count) = by_robot.middleRows(first, count);
  for (int i = first; i < look_columns; ++i) {
    places_[static_cast<std::size_t>(size_++)] = look_columns * static_cast<int>(look) + i;
  }
  camera_ += by_robot.bottomRows<camera_columns>();
}

void RobotRows::finish(int raw_camera_at) {
  rows_.middleRows<camera_columns>(size_) = camera_;
  for (int i = 0; i < camera_columns; ++i) {
    places_[static_cast<std::size_t>(size_++)] = raw_camera_at + i;
  }
}

Solver::Solver(Problem& problem, State& state) : problem_(problem), state_(state) {}

bool Solver::add_target(const Robot& robot) {
  const int target_at = robot.raw_columns();
  auto information = raw_information_.block<3, 3>(target_at, target_at);
  auto gradient = raw_gradient_.segment<3>(target_at);
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (!contains(problem_.target_kept, k)) continue;
    PointInLook seen;
    if (!robot.see_at_target_row(k, state_.target, seen)) return false;
    const Problem::TargetObservation& view = problem_.target[k];
    const Eigen::Vector2d residual = view.whitening * (seen.pixel - view.pixel);
    const Eigen::Matrix<double, 2, 3> by_point = view.whitening * seen.by_point;
    const Eigen::Matrix<double, 2, robot_columns> by_robot = view.whitening * seen.by_robot;
    add_to_look(k, by_robot, residual);
    const Eigen::Matrix<double, 3, robot_columns> mixed = by_point.transpose() * by_robot;
    const int look_at = look_columns * static_cast<int>(k);
    raw_information_.block<3, look_columns>(target_at, look_at) += mixed.leftCols<look_columns>();
    raw_information_.block<3, camera_columns>(target_at, robot.raw_camera_at()) +=
        mixed.rightCols<camera_columns>();
    information += by_point.transpose() * by_point;
    gradient += by_point.transpose() * residual;
    cost_ += residual.squaredNorm();
  }
  const double weak = std::pow(target_inverse_depth_sigma_per_m, -2);
  information(2, 2) += weak;
  gradient(2) += weak * state_.target.inverse_depth_per_m;
  cost_ += weak * std::pow(state_.target.inverse_depth_per_m, 2);
  return true;
}

void Solver::add_to_look(std::size_t k, const Eigen::Matrix<double, 2, robot_columns>& by_robot,
                         const Eigen::Vector2d& residual) {
  look_gradient_[k] += by_robot.transpose().lazyProduct(residual);
  for (int j = 0; j < robot_columns; ++j) {
    look_information_[k].col(j) +=
        by_robot.row(0).transpose() * by_robot(0, j) + by_robot.row(1).transpose() * by_robot(1, j);
  }
}

bool Solver::add_pixel(const Robot& robot, Loss loss, std::size_t index, std::size_t k,
                       Eigen::Matrix3d& information) {
  const Problem::Feature& given = problem_.features[index];
  const geometry::Pixel& pixel = given.observed->pixel[k];
  PointInLook seen;
  if (!robot.see(k, state_.features[index], pixel.y(), seen)) return false;
  const double per_px = 1.0 / (given.sigma_px * problem_.feature_scale);
  Eigen::Vector2d residual = per_px * (seen.pixel - pixel);
  const Weighted weighted = weigh(loss, residual.squaredNorm());
  cost_ += weighted.cost;
  const double root = std::sqrt(weighted.weight), scale = root * per_px;
  residual *= root;
  const Eigen::Matrix<double, 2, 3> by_point = scale * seen.by_point;
  const Eigen::Matrix<double, 2, robot_columns> by_robot = scale * seen.by_robot;
  information += by_point.transpose() * by_point;
  eliminated_[index].gradient += by_point.transpose() * residual;
  eliminated_[index].shared.add(k, by_robot.transpose().lazyProduct(by_point));
  add_to_look(k, by_robot, residual);
  return true;
}

bool Solver::add_feature(const Robot& robot, Loss loss, std::size_t index) {
  const LookSet kept = problem_.features[index].kept;
  if (kept == 0) return true;
  const double inverse_depth = state_.features[index].inverse_depth_per_m;
  constexpr double weak =
      1.0 / (feature_inverse_depth_sigma_per_m * feature_inverse_depth_sigma_per_m);
  Eigen::Matrix3d information = Eigen::Vector3d(0.0, 0.0, weak).asDiagonal();
  Eliminated& feature = eliminated_[index];
  feature.gradient = {0.0, 0.0, weak * inverse_depth};
  feature.shared.start();
  cost_ += weak * inverse_depth * inverse_depth;
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    if (contains(kept, k) && !add_pixel(robot, loss, index, k, information)) return false;
  }
  information.diagonal() *= 1.0 + damping_;
  feature.inverse_information = information.inverse();
  feature.shared.finish(robot.raw_camera_at());
  eliminate(feature);
  return true;
}

void Solver::eliminate(const Eliminated& feature) {
  const RobotRows& shared = feature.shared;
  const auto rows = shared.rows();
  const RobotRows::Rows gain = rows.lazyProduct(feature.inverse_information);
  const Eigen::Matrix<double, camera_columns, 3> camera_gain = gain.bottomRows<camera_columns>();
  const int of_looks = shared.size() - camera_columns, camera_at = shared.place(of_looks);
  for (int j = 0; j < shared.size(); ++j) {
    const int column = shared.place(j);
    const double x = rows(j, 0), y = rows(j, 1), z = rows(j, 2);
    for (int i = j; i < of_looks; ++i) {
      raw_information_(shared.place(i), column) -= gain(i, 0) * x + gain(i, 1) * y + gain(i, 2) * z;
    }
    raw_information_.col(column).segment<camera_columns>(camera_at) -=
        camera_gain.col(0) * x + camera_gain.col(1) * y + camera_gain.col(2) * z;
    raw_gradient_(column) -= gain.row(j).dot(feature.gradient);
  }
}

// A look's pixels by themselves; look 1's pose moves nothing.
void Solver::add_look(std::size_t k, int raw_camera_at) {
  const int first = k == 0 ? column_sweep : column_pose, count = look_columns - first;
  const int at = look_columns * static_cast<int>(k) + first;
  const auto& information = look_information_[k];
  raw_information_.block(at, at, count, count) += information.block(first, first, count, count);
  const auto mixed = information.block<camera_columns, Eigen::Dynamic>(column_camera, first,
                                                                       camera_columns, count);
  raw_information_.block(raw_camera_at, at, camera_columns, count) += mixed;
  raw_information_.block<camera_columns, camera_columns>(raw_camera_at, raw_camera_at) +=
      information.bottomRightCorner<camera_columns, camera_columns>();
  raw_gradient_.segment(at, count) += look_gradient_[k].segment(first, count);
  raw_gradient_.segment<camera_columns>(raw_camera_at) += look_gradient_[k].tail<camera_columns>();
}

bool Solver::linearise(Loss loss) {
  const Robot robot(problem_, state_.robot);
  const int columns = robot.raw_columns() + 3;
  raw_information_.setZero(columns, columns);
  raw_gradient_.setZero(columns);
  cost_ = state_.robot.squaredNorm();
  for (std::size_t k = 0; k < problem_.looks; ++k) {
    look_information_[k].setZero();
    look_gradient_[k].setZero();
  }
  if (!add_target(robot)) return false;
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    if (!add_feature(robot, loss, i)) return false;
  }
  for (std::size_t k = 0; k < problem_.looks; ++k) add_look(k, robot.raw_camera_at());
  raw_information_.triangularView<Eigen::StrictlyUpper>() = raw_information_.transpose();
  raw_from_unknowns_ = robot.raw_from_unknowns();
  information_ = robot.by_unknowns(robot.by_unknowns(raw_information_).transpose());
  gradient_ = robot.by_unknowns(raw_gradient_.transpose()).transpose();
  const int unknowns = problem_.robot_unknowns();
  information_.diagonal().head(unknowns).array() += 1.0;
  gradient_.head(unknowns) += state_.robot;
  return std::isfinite(cost_) && information_.allFinite() && gradient_.allFinite();
}

bool Solver::step(State& next) {
  Matrix damped = information_;
  damped.diagonal() *= 1.0 + damping_;
  if (!geometry::factorise(damped)) return false;
  Vector step = -gradient_;
  geometry::solve_factorised(damped, step);
  decrement_ = -gradient_.dot(step);
  if (!step.allFinite() || !std::isfinite(decrement_)) return false;
  const int unknowns = problem_.robot_unknowns();
  next = state_;
  next.robot += step.head(unknowns);
  next.target.direction += step.segment<2>(unknowns);
  next.target.inverse_depth_per_m += step(unknowns + 2);
  const Vector raw_step = raw_from_unknowns_.lazyProduct(step);
  step_features(raw_step.head(raw_step.size() - 3), next);
  return true;
}

void Solver::step_features(const Vector& raw_step, State& next) const {
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    if (problem_.features[i].kept == 0) continue;
    const Eliminated& feature = eliminated_[i];
    Eigen::Vector3d gradient = feature.gradient;
    for (int row = 0; row < feature.shared.size(); ++row) {
      gradient += raw_step(feature.shared.place(row)) * feature.shared.rows().row(row).transpose();
    }
    const Eigen::Vector3d step = feature.inverse_information * gradient;
    next.features[i].direction -= step.head<2>();
    next.features[i].inverse_depth_per_m -= step.z();
  }
}

bool Solver::raise_damping(Loss loss) {
  damping_ = std::max(least_damping, damping_growth * damping_);
  return damping_ < hopeless_damping && linearise(loss);
}

void Solver::drop_pixels_behind() {
  const Robot robot(problem_, state_.robot);
  PointInLook seen;
  for (std::size_t i = 0; i < problem_.feature_count; ++i) {
    LookSet& kept = problem_.features[i].kept;
    for (std::size_t k = 1; k < problem_.looks; ++k) {
      if (contains(kept, k) && !robot.see_at_target_row(k, state_.features[i], seen)) {
        kept = static_cast<LookSet>(kept & ~only_look(k));
      }
    }
  }
}

bool Solver::solve(Loss loss) {
  damping_ = 0.0;
  anchor_sweeps(state_.robot, problem_);
  drop_pixels_behind();
  if (!linearise(loss)) return false;
  State other = state_;
  for (int i = 0; i < iterations_max; ++i) {
    if (!step(other)) {
      if (!raise_damping(loss)) return false;
      continue;
    }
    std::swap(state_, other);  // `other` is now where the step began
    const bool at_rest = decrement_ < decrement_max(loss);
    if (at_rest && damping_ == 0.0) {
      // What is told of the solution is of the solution, not of where the last step began; Huber's
      // is but a start.
      return loss == Loss::huber || (linearise(loss) && factorise_information());
    }
    const double cost = cost_, damping = damping_;
    if (at_rest) damping_ = 0.0;
    if (linearise(loss) && (at_rest || cost_ <= cost * (1.0 + cost_rounding))) {
      damping_ = damping_ > least_damping ? damping_ / damping_growth : 0.0;
    } else {
      std::swap(state_, other);
      damping_ = damping;
      if (!raise_damping(loss)) return false;
    }
  }
  return false;
}

double Solver::inverse_depth_sigma_per_m(std::size_t feature) {
  const Eliminated& eliminated = eliminated_[feature];
  const Eigen::Vector3d gain = eliminated.inverse_information.col(2);
  Vector by_raw = Vector::Zero(raw_from_unknowns_.rows());
  for (int row = 0; row < eliminated.shared.size(); ++row) {
    by_raw(eliminated.shared.place(row)) = -eliminated.shared.rows().row(row).dot(gain);
  }
  const Vector by_unknowns = raw_from_unknowns_.transpose().lazyProduct(by_raw);
  const Vector spread = covariance().lazyProduct(by_unknowns);
  return std::sqrt(gain.z() + by_unknowns.dot(spread));
}

bool Solver::factorise_information() {
  factors_ = information_;
  covariance_is_made_ = false;
  return geometry::factorise(factors_);
}

const Matrix& Solver::covariance() {
  if (!covariance_is_made_) {
    covariance_.setIdentity(factors_.rows(), factors_.cols());
    geometry::solve_factorised(factors_, covariance_);
    covariance_is_made_ = true;
  }
  return covariance_;
}

}  // namespace gazed::triangulation::all_looks
