#include "agent/triangulation/all_looks/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agent/geometry/cholesky.hpp"

namespace gazed::triangulation::all_looks {

namespace {

/// Levenberg and Marquardt's damping, relative to the information's diagonal.
constexpr double least_damping = 1e-8;
constexpr double damping_growth = 10.0;
constexpr double hopeless_damping = 1e9;
constexpr int iterations_max = 100;
/// Costs that differ by less than this, relatively, count as equal.
constexpr double cost_rounding = 1e-9;
/// Information that is not renewed must shrink each squared step by at least this factor.
constexpr double decrease_min = 30.0;
/// This close (squared standard deviations), renewing would help little more: with large residuals
/// Gauss-Newton's own steps shrink as slowly. Then this smaller factor is enough.
constexpr double close_by_max = 1e-2, decrease_min_close_by = 2.0;
/// Distances in squared standard deviations. Results are reported from information made no farther
/// from the solution than the first; a step shorter than the second leads there. The torso's level
/// is chosen from the third.
constexpr double at_solution_max = 1e-4, last_but_one_max = 3.0, near_solution_max = 1.0;

/// The squared step, in standard deviations, at which the solution stops moving: each step is at
/// least hundreds of times shorter than the one before. With Huber's loss the solution is only a
/// starting point.
double decrement_max(Loss loss) {
  return loss == Loss::huber ? 1.0 : 1e-8;
}

}  // namespace

Solver::Solver(Problem& problem, State& state)
    : problem_(problem), state_(state), equations_(problem) {}

bool Solver::linearise(Loss loss, Renew renew) {
  std::optional<Robot> now;  // besides the one that the information was made with
  const Robot& robot = (renew == Renew::gradient ? now : robot_).emplace(problem_, state_.robot);
  const bool valid = renew == Renew::all      ? equations_.linearise(robot, state_, loss, damping_)
                     : renew == Renew::target ? equations_.renew_target(robot, state_)
                                              : equations_.renew_gradient(robot, state_);
  if (!valid) return false;
  cost_ = state_.robot.squaredNorm() + equations_.cost();
  gradient_ = robot.by_unknowns(equations_.gradient().transpose()).transpose();
  const int unknowns = problem_.robot_unknowns();
  gradient_.head(unknowns) += state_.robot;
  if (renew != Renew::gradient) {
    factors_ = robot.information_by_unknowns(equations_.information());
    factors_.diagonal().head(unknowns).array() += 1.0;
    factors_.diagonal() *= 1.0 + damping_;
    for (Eigen::Index j = 0; j < factors_.cols(); ++j) {
      if (!factors_.col(j).tail(factors_.rows() - j).allFinite()) return false;
    }
    factorised_ = geometry::factorise(factors_);
    covariance_is_made_ = false;
  }
  if (renew == Renew::all) moved_ = 0.0;
  return std::isfinite(cost_) && gradient_.allFinite();
}

bool Solver::step(State& next) {
  if (!factorised_) return false;
  Vector step = -gradient_;
  geometry::solve_factorised(factors_, step);
  decrement_ = -gradient_.dot(step);
  if (!step.allFinite() || !std::isfinite(decrement_)) return false;
  next = state_;
  take(step, next);
  return true;
}

void Solver::take(const Vector& step, State& state) const {
  const int unknowns = problem_.robot_unknowns();
  state.robot += step.head(unknowns);
  state.target.direction += step.segment<2>(unknowns);
  state.target.inverse_depth_per_m += step(unknowns + 2);
  equations_.step_features(robot_->raw_step(step), state);
}

bool Solver::raise_damping(Loss loss) {
  damping_ = std::max(least_damping, damping_growth * damping_);
  return damping_ < hopeless_damping && linearise(loss, Renew::all);
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

/// True if the information of an earlier state will do: nearby as long as steps shrink, from far
/// off only if they shrink fast.
bool Solver::information_serves(double last_decrement) const {
  if (moved_ <= close_by_max) return decrease_min_close_by * decrement_ < last_decrement;
  return decrease_min * decrement_ < last_decrement && decrement_ > last_but_one_max;
}

bool Solver::solve(Loss loss) {
  damping_ = 0.0;
  anchor_sweeps(state_.robot, problem_);
  const bool known = loss == Loss::squares && equations_.is_of_the_same_pixels();
  if (!linearise(loss, known ? Renew::target : Renew::all)) {
    drop_pixels_behind();
    if (!linearise(loss, Renew::all)) return false;
  }
  State other = state_;
  double last = std::numeric_limits<double>::infinity();
  bool is_renewed = !known;
  for (int i = 0; i < iterations_max; ++i) {
    if (!step(other)) {
      if (!raise_damping(loss)) return false;
      continue;
    }
    std::swap(state_, other);  // `other` now holds the state before the step
    const bool at_rest = decrement_ < decrement_max(loss);
    moved_ += decrement_;
    if (at_rest && damping_ == 0.0) return true;
    const double cost = cost_, damping = damping_;
    if (at_rest) damping_ = 0.0;
    const bool near = loss == Loss::squares && damping == 0.0 && information_serves(last);
    last = decrement_;
    if (linearise(loss, near ? Renew::gradient : Renew::all) &&
        (at_rest || cost_ <= cost * (1.0 + cost_rounding))) {
      damping_ = damping_ > least_damping ? damping_ / damping_growth : 0.0;
      is_renewed = !near;
      continue;
    }
    std::swap(state_, other);
    damping_ = damping;
    if (!(is_renewed ? raise_damping(loss) : linearise(loss, Renew::all))) return false;
    is_renewed = true;
    last = std::numeric_limits<double>::infinity();
  }
  return false;
}

void Solver::tighten_torso(TorsoSigma torso, const Vector& pull) {
  const int first = problem_.torso_of(1);
  moved_ += pull.dot(state_.robot.segment(first, pull.size()));
  Vector step = Vector::Zero(problem_.unknowns());
  step.segment(first, pull.size()) = -pull;
  geometry::solve_factorised(factors_, step);
  take(step, state_);
  set_torso(torso, problem_, state_);
}

Matrix Solver::target_row(std::size_t look) const {
  return robot_->by_unknowns(equations_.target_row(look));
}

double Solver::inverse_depth_sigma_per_m(std::size_t feature) const {
  Vector by_raw;
  const double variance = equations_.inverse_depth_variance(feature, by_raw);
  const Vector by_unknowns = robot_->by_unknowns(by_raw.transpose()).transpose();
  Vector spread = by_unknowns;
  geometry::solve_factorised(factors_, spread);
  return std::sqrt(variance + by_unknowns.dot(spread));
}

/// Renews information that was made farther than this from the solution.
void Solver::be_within(double squared_distance) {
  if (moved_ <= squared_distance) return;
  static_cast<void>(linearise(Loss::squares, Renew::all));
}

double Solver::badness() {
  be_within(near_solution_max);
  return cost_ + 2.0 * factors_.diagonal().array().log().sum();
}

const Matrix& Solver::covariance() {
  be_within(at_solution_max);
  if (!covariance_is_made_) {
    covariance_ = factors_;
    geometry::invert_factorised(covariance_);
    covariance_is_made_ = true;
  }
  return covariance_;
}

Matrix Solver::torso_covariance() {
  be_within(near_solution_max);
  const int count = problem_.unknowns() - problem_.torso_of(1);
  // The last part of the inverse depends only on the last part of the factors.
  Matrix out = factors_.bottomRightCorner(count, count);
  geometry::invert_factorised(out);
  return out;
}

Matrix Solver::information_without_target() {
  be_within(at_solution_max);
  const Matrix& features = equations_.features_information();
  Matrix raw = Matrix::Zero(features.rows() + 3, features.cols() + 3);
  raw.topLeftCorner(features.rows(), features.cols()) = features;
  const Matrix information = robot_->information_by_unknowns(raw);
  const int unknowns = problem_.robot_unknowns();
  Matrix out = information.topLeftCorner(unknowns, unknowns);
  out.diagonal().array() += 1.0;
  return out;
}

}  // namespace gazed::triangulation::all_looks
