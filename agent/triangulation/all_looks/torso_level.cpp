#include "agent/triangulation/all_looks/torso_level.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "agent/geometry/cholesky.hpp"

namespace gazed::triangulation::all_looks {

namespace {

// Levels in metres and radians, a factor of two apart in the range of standing robots; the lowest
// is no motion. Levels above the loosest one allowed are left out.
constexpr std::array<TorsoSigma, 7> ladder{{{0.0, 0.0},
                                            {0.25e-3, 0.15e-3},
                                            {0.5e-3, 0.3e-3},
                                            {1e-3, 0.5e-3},
                                            {2e-3, 1e-3},
                                            {5e-3, 2e-3},
                                            {12e-3, 5e-3}}};
constexpr std::size_t least_of_few_looks = 2;
constexpr std::size_t many_looks = 4;
// A robot stands still unless there is strong evidence against it (2 log of the Bayes factor: Kass
// and Raftery, JASA 90, 1995). Without a background there hardly ever is.
constexpr double strong_evidence = 6.0;
// relative to the inverse depth: the correction is a first-order one
constexpr double most_shift = 0.3;

TorsoSigma at_most(TorsoSigma level, TorsoSigma limit) {
  return {std::min(level.rotation_rad, limit.rotation_rad),
          std::min(level.translation_m, limit.translation_m)};
}

/// The rung of stillest_torso().
std::size_t least_of(const Problem& problem) {
  return problem.looks < many_looks ? least_of_few_looks : 0;
}

/// -2 log of a level's evidence relative to that of the loosest level, from a solution with the
/// loosest level and for the torso's unknowns alone, in its standard deviations. A tighter prior
/// acts like one more measurement of every unknown, of value 0 and with the variance v that turns
/// one prior's information into the other's. The evidence changes by that of this measurement's
/// innovation, whose covariance is C + v, and by how much the prior's volume shrinks. `pull`
/// becomes the innovation divided by its covariance.
double badness(TorsoSigma loosest, TorsoSigma level, const Vector& found, const Matrix& covariance,
               Vector& pull) {
  const auto variance = [](double loosest_sigma, double sigma) {
    if (sigma == 0.0) return 0.0;
    const double information = loosest_sigma * loosest_sigma / (sigma * sigma) - 1.0;
    // for the loosest level itself: as good as no measurement
    return 1.0 / std::max(information, 1e-12);
  };
  const double rotation = variance(loosest.rotation_rad, level.rotation_rad);
  const double translation = variance(loosest.translation_m, level.translation_m);
  Matrix innovation = covariance;
  double out = 0.0;
  for (Eigen::Index i = 0; i < innovation.rows(); ++i) {
    const double more = i % torso_unknowns < 3 ? rotation : translation;
    innovation(i, i) += more;
    out -= std::log(1.0 + more);  // (C + v) for priors about which nothing was learnt
  }
  if (!geometry::factorise(innovation)) return std::numeric_limits<double>::infinity();
  pull = found;
  geometry::solve_factorised(innovation, pull);
  out += found.dot(pull);
  for (Eigen::Index i = 0; i < innovation.rows(); ++i) out += 2.0 * std::log(innovation(i, i));
  return out;
}

}  // namespace

std::optional<LikeliestTorso> likeliest_torso(const Problem& problem, const State& state,
                                              const Matrix& torso_covariance) {
  const int unknowns = problem.robot_unknowns() - problem.torso_of(1);
  const Vector found = state.robot.tail(unknowns);
  const Matrix covariance = torso_covariance.topLeftCorner(unknowns, unknowns);
  const std::size_t least_level = least_of(problem);
  std::optional<LikeliestTorso> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = least_level; i < ladder.size(); ++i) {
    LikeliestTorso level{at_most(ladder[i], problem.torso), {}};
    const double bad = badness(problem.torso, level.sigma, found, covariance, level.pull) +
                       (i > least_level ? strong_evidence : 0.0);
    if (!(bad < least)) continue;
    least = bad;
    best = level;
  }
  return best;
}

TorsoSigma stillest_torso(const Problem& problem) {
  return at_most(ladder[least_of(problem)], problem.torso);
}

TorsoSigma below_loosest(const Problem& problem) {
  return at_most(ladder[ladder.size() - 2], problem.torso);
}

TorsoSigma torso_of_another_look(const Problem& problem) {
  const TorsoSigma least = ladder[least_of_few_looks];
  const bool are_enough = problem.looks < many_looks && problem.looks + 1 >= many_looks;
  const bool none_was_seen = problem.torso.rotation_rad <= least.rotation_rad &&
                             problem.torso.translation_m <= least.translation_m;
  if (!are_enough || !none_was_seen) return problem.torso;
  return at_most(ladder.front(), problem.torso);
}

void weigh_scale(const Problem& problem, const Matrix& covariance, State& state) {
  const int robot = problem.robot_unknowns(), depth = robot + 2;
  const double inverse_depth = state.target.inverse_depth_per_m;
  const double variance = covariance(depth, depth);
  if (!(problem.torso.translation_m > 0.0) || !(inverse_depth > 0.0)) return;
  // How many coordinates the images determine at a given scale; the others keep their prior.
  double determined = 0.0;
  for (std::size_t k = 1; k < problem.looks; ++k) {
    for (int i = 0; i < 3; ++i) {
      const int at = problem.torso_of(k) + 3 + i;
      determined += 1.0 - covariance(at, at) + std::pow(covariance(at, depth), 2) / variance;
    }
  }
  const double shift = -std::min(determined / inverse_depth, most_shift * inverse_depth / variance);
  state.robot += shift * covariance.col(depth).head(robot);
  state.target.direction += shift * covariance.col(depth).segment<2>(robot);
  state.target.inverse_depth_per_m += shift * variance;
}

}  // namespace gazed::triangulation::all_looks
