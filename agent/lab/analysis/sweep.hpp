// Figure 3.1: one parameter moves through its uncertainty while all else is exact.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "agent/lab/analysis/estimator.hpp"
#include "agent/lab/analysis/setup.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::lab::analysis {

struct SweepRow {
  const TwoViewSetup* setup = nullptr;
  Parameter parameter = Parameter::focal;
  double error = 0.0;  // of each of the parameter's elements: px, rad or m
  /// Mean length of the error vector over the five points, in the order of all_estimators; NaN when
  /// one of them has no finite answer.
  std::array<double, all_estimators.size()> mean_error_m{};
  /// What the gate says of each of the five points (estimate_point, optimal method, all sigmas of
  /// the setup, which is what a robot knows of the error).
  std::vector<triangulation::Status> statuses{};
};

/// For each parameter `samples` (at least 2) errors from -2 sigma to 2 sigma, evenly spaced.
/// `parameter_done` is called after each parameter.
[[nodiscard]] std::vector<SweepRow> sweep(const TwoViewSetup& setup, std::size_t samples,
                                          const std::function<void()>& parameter_done);

}  // namespace gazed::lab::analysis
