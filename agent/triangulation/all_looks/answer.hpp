// Turns a solution of the all-looks problem into an answer, with the same checks as for two looks.
#pragma once

#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation::all_looks {

/// Parallax and residual, which need no position. The status is left for the caller to fill in.
[[nodiscard]] PointEstimate images_of(const Problem& problem, const State& state);

/// Judges the solution by its covariance: baselines against their sigmas and rays against the
/// baselines (DEGENERATE if no look that was kept stands anywhere else than look 1), cheirality
/// (BEHIND_CAMERA), relative sigma (UNCERTAIN).
[[nodiscard]] PointEstimate answer_of(const Problem& problem, const State& state,
                                      const Matrix& covariance, const Gate& gate);

}  // namespace gazed::triangulation::all_looks
