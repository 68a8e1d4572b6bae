// From a solution of the problem of all looks to an answer, by the checks of a pair of looks.
#pragma once

#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation::all_looks {

/// Parallax and residual: what is known without a position. The status is left to be filled.
[[nodiscard]] PointEstimate images_of(const Problem& problem, const State& state);

/// By the solution's covariance: baselines against their sigmas and rays against the baselines
/// (DEGENERATE when no look kept stands anywhere else than look 1), cheirality (BEHIND_CAMERA),
/// relative sigma (UNCERTAIN).
[[nodiscard]] PointEstimate answer_of(const Problem& problem, const State& state,
                                      const Matrix& covariance, const Gate& gate);

}  // namespace gazed::triangulation::all_looks
