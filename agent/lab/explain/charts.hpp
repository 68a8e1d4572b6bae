// The numbers of a fixation as charts, drawn by gnuplot: scripts with their data.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "agent/cycle/fixation.hpp"
#include "agent/triangulation/all_looks/error_budget.hpp"

namespace gazed::lab::explain {

/// A range with its interval of so many sigmas, which is one of inverse range: it may reach
/// infinity. What is behind the camera is none.
struct RangeInterval {
  double near_m = triangulation::not_a_number;
  double far_m = triangulation::not_a_number;  // may be infinite
};
[[nodiscard]] std::optional<RangeInterval> interval_of(double inverse_range_per_m,
                                                       double inverse_range_sigma_per_m,
                                                       double sigmas);

/// What one cause of error costs.
struct Cost {
  std::string_view cause;
  /// Sigma of the range that it alone would leave, and that all others would, as a share of the
  /// range.
  double alone = triangulation::not_a_number;
  double without = triangulation::not_a_number;
  double share = triangulation::not_a_number;  // of the variance
};
/// The dearest first; empty where there is no answer, or one at infinity.
[[nodiscard]] std::vector<Cost> costs_of(const cycle::Fixation& fixation);

/// gnuplot's script for NAME.svg and NAME.png; empty where there is nothing to draw.
[[nodiscard]] std::string interval_script(const cycle::Fixation& fixation, const std::string& name);
[[nodiscard]] std::string costs_script(const std::vector<Cost>& costs, const std::string& name);

}  // namespace gazed::lab::explain
