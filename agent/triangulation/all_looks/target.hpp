// Whether the looks show one and the same target, and what is known of it then.
#pragma once

#include <array>
#include <cstddef>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/triangulation/all_looks/error_budget.hpp"
#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/all_looks/solver.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation::all_looks {

/// The target's image points against each other and against all that is known of the looks.
struct TargetAgreement {
  double chi2 = 0.0;
  int degrees_of_freedom = 0;  // two for each later look, less the inverse depth
  std::size_t worst_look = 0;  // the one that the others contradict most; 0: only two looks
  double worst_chi2 = 0.0;     // of that one's innovation, two degrees of freedom
  std::array<double, looks_max> look_chi2{};  // of every later look's that is kept
};

/// At a solution.
[[nodiscard]] TargetAgreement target_agreement(const Problem& problem, const State& state,
                                               Solver& solver);

/// The target's inverse range and its covariances at a solution, in camera 1 and in the torso.
[[nodiscard]] Propagated target_uncertainty(const Robot& robot, const State& state,
                                            const Matrix& covariance);

/// What each cause costs the target's inverse range, at a solution. There it is linear in what it
/// is made of: its error is the sum of the errors of what was believed before (each unknown's
/// prior) and of the pixels, by the gain that the information gives them (Rodgers, Inverse methods
/// for atmospheric sounding, 2000, 3.2).
[[nodiscard]] ErrorBudget target_budget(const Problem& problem, const State& state, Solver& solver);

/// Standard deviation of the length of a later look's baseline, metres.
[[nodiscard]] double baseline_sigma_m(const Robot& robot, std::size_t look,
                                      const Matrix& covariance);

}  // namespace gazed::triangulation::all_looks
