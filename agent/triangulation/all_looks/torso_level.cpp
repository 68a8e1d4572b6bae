#include "agent/triangulation/all_looks/torso_level.hpp"

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

/// By unknown, in the loosest level's standard deviations: a prior's information.
Vector prior_information(const Problem& problem, TorsoSigma level) {
  Vector out = Vector::Zero(problem.unknowns());
  const double rotation = std::pow(problem.torso.rotation_rad / level.rotation_rad, 2);
  const double translation = std::pow(problem.torso.translation_m / level.translation_m, 2);
  for (std::size_t k = 1; k < problem.looks; ++k) {
    out.segment<3>(unknowns_of(k) + torso_at).setConstant(rotation);
    out.segment<3>(unknowns_of(k) + torso_at + 3).setConstant(translation);
  }
  return out;
}

/// -2 log of the evidence, but for what all levels share.
double badness(const Problem& problem, const State& state, const Matrix& information,
               TorsoSigma level) {
  const Vector prior = prior_information(problem, level);
  const Vector loosest = prior_information(problem, problem.torso);
  const Vector more = prior - loosest;
  Matrix factors = information;
  factors.diagonal() += more;
  if (!geometry::factorise(factors)) return std::numeric_limits<double>::infinity();
  Vector found = Vector::Zero(problem.unknowns());
  found.head(problem.robot_unknowns()) = state.robot;
  const Vector pull = more.cwiseProduct(found);
  Vector answer = pull;
  geometry::solve_factorised(factors, answer);
  double out = found.dot(pull) - pull.dot(answer);
  for (Eigen::Index i = 0; i < factors.rows(); ++i) out += 2.0 * std::log(factors(i, i));
  for (Eigen::Index i = 0; i < prior.size(); ++i) {
    if (prior(i) > 0.0) out -= std::log(prior(i));
  }
  return out;
}

}  // namespace

std::optional<TorsoSigma> likeliest_torso(const Problem& problem, const State& state,
                                          const Solver& solver) {
  std::optional<TorsoSigma> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = least_of(problem); i < ladder.size(); ++i) {
    const TorsoSigma level{std::min(ladder[i].rotation_rad, problem.torso.rotation_rad),
                           std::min(ladder[i].translation_m, problem.torso.translation_m)};
    const double bad = badness(problem, state, solver.information(), level) +
                       (i > least_of(problem) ? strong_evidence : 0.0);
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
