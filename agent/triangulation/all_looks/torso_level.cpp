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

// Millimetres and milliradians a level, a factor of two apart where standing robots are; the least
// is none. Those that the loosest does not allow are left out.
constexpr std::array<TorsoSigma, 7> ladder{{{1e-6, 1e-6},
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
// Of the inverse depth: the correction is of first order.
constexpr double most_shift = 0.3;

/// The stillest level that so many looks can be believed to show.
std::size_t least_of(const Problem& problem) {
  return problem.looks < many_looks ? least_of_few_looks : 0;
}

constexpr int torso_unknowns = 6;
constexpr int torso_max = torso_unknowns * (static_cast<int>(looks_max) - 1);
using TorsoVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, torso_max, 1>;
using TorsoMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, torso_max, torso_max>;

/// What a solution with the loosest level says of the torso's unknowns alone, in its standard
/// deviations.
struct Marginal {
  TorsoVector found;
  TorsoMatrix covariance;
};

Marginal marginal_of(const Problem& problem, const State& state, const Matrix& covariance) {
  const auto later = static_cast<Eigen::Index>(problem.looks) - 1;
  Marginal out{TorsoVector(torso_unknowns * later),
               TorsoMatrix(torso_unknowns * later, torso_unknowns * later)};
  const auto at = [](Eigen::Index look) {
    return unknowns_of(static_cast<std::size_t>(look) + 1) + torso_at;
  };
  for (Eigen::Index j = 0; j < later; ++j) {
    out.found.segment<torso_unknowns>(torso_unknowns * j) =
        state.robot.segment<torso_unknowns>(at(j));
    for (Eigen::Index i = 0; i < later; ++i) {
      out.covariance.block<torso_unknowns, torso_unknowns>(torso_unknowns * i, torso_unknowns * j) =
          covariance.block<torso_unknowns, torso_unknowns>(at(i), at(j));
    }
  }
  return out;
}

/// -2 log of the evidence against that of the loosest level. A tighter prior is one more
/// measurement of every unknown, of 0 with the variance v that makes both priors' information that
/// of the level: the evidence's change is that of its innovation, whose covariance is C + v, beside
/// how much the prior's volume shrinks.
double badness(const Problem& problem, const Marginal& marginal, TorsoSigma level) {
  const auto variance = [](double loosest, double sigma) {
    const double information = loosest * loosest / (sigma * sigma) - 1.0;
    return 1.0 / std::max(information, 1e-12);  // the loosest itself: as good as no measurement
  };
  const double rotation = variance(problem.torso.rotation_rad, level.rotation_rad);
  const double translation = variance(problem.torso.translation_m, level.translation_m);
  TorsoMatrix innovation = marginal.covariance;
  double out = 0.0;
  for (Eigen::Index i = 0; i < innovation.rows(); ++i) {
    const double more = i % torso_unknowns < 3 ? rotation : translation;
    innovation(i, i) += more;
    out -= std::log(1.0 + more);  // (C + v) of a prior that nothing was learnt beyond
  }
  if (!geometry::factorise(innovation)) return std::numeric_limits<double>::infinity();
  TorsoVector answer = marginal.found;
  geometry::solve_factorised(innovation, answer);
  out += marginal.found.dot(answer);
  for (Eigen::Index i = 0; i < innovation.rows(); ++i) out += 2.0 * std::log(innovation(i, i));
  return out;
}

}  // namespace

std::optional<TorsoSigma> likeliest_torso(const Problem& problem, const State& state,
                                          const Matrix& covariance) {
  const Marginal marginal = marginal_of(problem, state, covariance);
  std::optional<TorsoSigma> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = least_of(problem); i < ladder.size(); ++i) {
    const TorsoSigma level{std::min(ladder[i].rotation_rad, problem.torso.rotation_rad),
                           std::min(ladder[i].translation_m, problem.torso.translation_m)};
    const double bad =
        badness(problem, marginal, level) + (i > least_of(problem) ? strong_evidence : 0.0);
    if (!(bad < least)) continue;
    least = bad;
    best = level;
  }
  return best;
}

void set_torso(TorsoSigma torso, Problem& problem, State& state) {
  for (std::size_t k = 1; k < problem.looks; ++k) {
    const int at = unknowns_of(k) + torso_at;
    state.robot.segment<3>(at) *= problem.torso.rotation_rad / torso.rotation_rad;
    state.robot.segment<3>(at + 3) *= problem.torso.translation_m / torso.translation_m;
  }
  problem.torso = torso;
}

void weigh_scale(const Problem& problem, const Matrix& covariance, State& state) {
  const int robot = problem.robot_unknowns(), depth = robot + 2;
  const double inverse_depth = state.target.inverse_depth_per_m;
  const double variance = covariance(depth, depth);
  if (!(problem.torso.translation_m > 0.0) || !(inverse_depth > 0.0)) return;
  // How many coordinates the images determine at a given scale: the others keep their prior.
  double determined = 0.0;
  for (std::size_t k = 1; k < problem.looks; ++k) {
    for (int i = 0; i < 3; ++i) {
      const int at = unknowns_of(k) + torso_at + 3 + i;
      determined += 1.0 - covariance(at, at) + std::pow(covariance(at, depth), 2) / variance;
    }
  }
  const double shift = -std::min(determined / inverse_depth, most_shift * inverse_depth / variance);
  state.robot += shift * covariance.col(depth).head(robot);
  state.target.direction += shift * covariance.col(depth).segment<2>(robot);
  state.target.inverse_depth_per_m += shift * variance;
}

}  // namespace gazed::triangulation::all_looks
