// Whether the looks show one and the same target, and how well it is then known.
#pragma once

#include <array>
#include <cstddef>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/triangulation/all_looks/error_budget.hpp"
#include "agent/triangulation/all_looks/problem.hpp"
#include "agent/triangulation/all_looks/solver.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation::all_looks {

/// The target's image points, compared with each other and with everything known about the looks.
struct TargetAgreement {
  double chi2 = 0.0;
  int degrees_of_freedom = 0;  // two per later look, minus one for the inverse depth
  std::size_t worst_look = 0;  // the look that the others contradict most; 0: only two looks
  double worst_chi2 = 0.0;     // chi-square of its innovation, two degrees of freedom
  std::array<double, looks_max> look_chi2{};  // the same for every later look that is kept
};

/// To be called at a solution.
[[nodiscard]] TargetAgreement target_agreement(const Problem& problem, const State& state,
                                               Solver& solver);

/// The target's inverse range at a solution, and its covariances in camera 1 and in the torso.
[[nodiscard]] Propagated target_uncertainty(const Robot& robot, const State& state,
                                            const Matrix& covariance);

/// How much each cause contributes to the error of the target's inverse range, at a solution. There
/// the error is linear: the sum of the errors of all priors and pixels, times the gains that the
/// information gives them (Rodgers, Inverse methods for atmospheric sounding, 2000, 3.2).
[[nodiscard]] ErrorBudget target_budget(const Problem& problem, const State& state, Solver& solver);

/// Standard deviation of the length of a later look's baseline, metres.
[[nodiscard]] double baseline_sigma_m(const Robot& robot, std::size_t look,
                                      const Matrix& covariance);

}  // namespace gazed::triangulation::all_looks
