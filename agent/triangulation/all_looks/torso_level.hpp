// How much the torso moves between the looks. No sensor measures it, so the looks must show it.
//
// A standing robot sways by millimetres and milliradians, which moves the camera as much as turning
// the head does. Six unknowns per look can describe that, but would cost a robot that stands still
// much of its accuracy. So the sigma of those unknowns, the level, is chosen from a ladder by its
// evidence: the level that makes the observations most likely (MacKay, Bayesian interpolation,
// Neural Computation 4, 1992), computed from the quadratic around a solution with the loosest
// level.
#pragma once

#include <optional>

#include "agent/triangulation/all_looks/problem.hpp"

namespace gazed::triangulation::all_looks {

struct LikeliestTorso {
  TorsoSigma sigma;
  /// How this level's prior pulls the torso's unknowns back, in the loosest level's standard
  /// deviations: Solver::tighten_torso.
  Vector pull;
};

/// Searches from no motion to the loosest level. Fewer than four looks cannot tell sway from a move
/// of the target, so no such robot is taken to stand still.
///
/// `state` and `torso_covariance` (Solver::torso_covariance) belong to a solution with the loosest
/// level, `problem.torso`. None if the covariance is not positive definite.
[[nodiscard]] std::optional<LikeliestTorso> likeliest_torso(const Problem& problem,
                                                            const State& state,
                                                            const Matrix& torso_covariance);

/// The stillest level that this many looks can support.
[[nodiscard]] TorsoSigma stillest_torso(const Problem& problem);

/// The problem's level, or the one below where that is the loosest of the ladder.
[[nodiscard]] TorsoSigma below_loosest(const Problem& problem);

/// The level expected with one more look than the problem has: the present one, or standing still
/// if there were only too few looks to support that.
[[nodiscard]] TorsoSigma torso_of_another_look(const Problem& problem);

/// Moves from the most likely state to the scale that is likely when all translations of the torso
/// are counted.
///
/// The images determine the torso's translations only up to a common scale s, that of all inverse
/// depths; each is known to 1/s of the pixels' accuracy. The state has the most likely
/// translations. Counting all of them, each well determined coordinate contributes a factor 1/s to
/// the likelihood of s, and the point moves farther away: by 2 % of the range for eight looks that
/// determine it to 3 %.
void weigh_scale(const Problem& problem, const Matrix& covariance, State& state);

}  // namespace gazed::triangulation::all_looks
