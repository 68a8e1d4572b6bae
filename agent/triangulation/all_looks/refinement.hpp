// The head's angles from the background: solving with features of which some are wrong, and
// deciding whether to believe the result.
#pragma once

#include <optional>

#include "agent/triangulation/all_looks/features.hpp"
#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/all_looks/solver.hpp"

namespace gazed::triangulation::all_looks {

/// Fewer features cannot outvote a wrong one.
inline constexpr std::size_t features_min = 8;

/// Solves the problem with its features. Those that agree stay in the problem; returns how well
/// they do, or nothing if there is no solution.
[[nodiscard]] std::optional<FeatureAgreement> solve_with_features(Problem& problem, State& state,
                                                                  Solver& solver);

/// True if the features contradict neither each other nor the encoders.
[[nodiscard]] bool is_plausible(const Problem& problem, const State& state,
                                const FeatureAgreement& agreement);

}  // namespace gazed::triangulation::all_looks
