// How much the torso moves between the looks: nobody says so, the looks do.
//
// A standing robot sways by millimetres and milliradians, which moves the camera as much as the
// lever arm's turn does. Six unknowns a look can hold that, but a robot that stands still would pay
// for them. So the sigmas of those unknowns, the level, are chosen by evidence: of a ladder of
// levels the one under which what was seen is most likely (MacKay, Bayesian interpolation, Neural
// Computation 4, 1992), by the quadratic that a solution with the loosest level leaves.
#pragma once

#include <optional>

#include "agent/triangulation/all_looks/problem.hpp"

namespace gazed::triangulation::all_looks {

struct LikeliestTorso {
  TorsoSigma sigma;
  /// What such a prior pulls the torso's unknowns back with, by the loosest level's standard
  /// deviations: Solver::tighten_torso.
  Vector pull;
};

/// From no motion to the loosest. Fewer than four looks cannot tell a sway from a move of the
/// target: they are not believed to be still.
///
/// `state` and `torso_covariance` (Solver::torso_covariance) are a solution's with the loosest
/// level, `problem.torso`. None when the covariance is not positive definite.
[[nodiscard]] std::optional<LikeliestTorso> likeliest_torso(const Problem& problem,
                                                            const State& state,
                                                            const Matrix& torso_covariance);

/// The level that is expected with one look more than the problem has: the present one, or that of
/// a robot that stands still, where those so far were only too few to believe in it.
[[nodiscard]] TorsoSigma torso_of_another_look(const Problem& problem);

/// From the likeliest state to the scale that is likely with all translations of the torso
/// together.
///
/// The images fix the torso's translations but for a common scale, that of all inverse depths, s:
/// each is then known to 1/s of what the pixels are known to. The state is where the most likely of
/// them are likeliest; with all of them counted, each well determined coordinate makes s likely in
/// 1/s, and the point lies farther off: by 2 % of the range for eight looks that tell it to 3 %.
void weigh_scale(const Problem& problem, const Matrix& covariance, State& state);

}  // namespace gazed::triangulation::all_looks
