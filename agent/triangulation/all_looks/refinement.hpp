// The head's angles from the background: solving with features of which some are wrong, and whether
// to believe the result.
#pragma once

#include <optional>

#include "agent/triangulation/all_looks/features.hpp"
#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/all_looks/solver.hpp"

namespace gazed::triangulation::all_looks {

/// Fewer features cannot outvote a wrong one.
inline constexpr std::size_t features_min = 8;

/// Solves the problem with its features: those that agree are left in it, and how far they do is
/// returned. None when nothing comes of it.
[[nodiscard]] std::optional<FeatureAgreement> solve_with_features(Problem& problem, State& state,
                                                                  Solver& solver);

/// Whether the features contradict neither each other nor the encoders.
[[nodiscard]] bool is_plausible(const Problem& problem, const State& state,
                                const FeatureAgreement& agreement);

}  // namespace gazed::triangulation::all_looks
