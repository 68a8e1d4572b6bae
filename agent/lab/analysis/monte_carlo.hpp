// Table 3.3: what random errors of one parameter do to a point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "agent/lab/analysis/estimator.hpp"
#include "agent/lab/analysis/setup.hpp"

namespace gazed::lab::analysis {

/// How errors are drawn. The report took random values within two sigmas; calibrations are
/// Gaussian.
enum class Draws { uniform, gaussian };
inline constexpr std::array all_draws{Draws::uniform, Draws::gaussian};

/// "uniform", "gaussian".
[[nodiscard]] std::string_view name(Draws draws);

/// Of the errors of many estimates of one point. A number that nothing was measured for is NaN.
struct ErrorStatistics {
  /// As the report: mean and standard deviation of the error vector, element by element, and the
  /// length of each; rms is both together. Estimates behind a camera count, those without a finite
  /// answer do not. Where a disparity may pass 0 the last two do not exist: they grow with the
  /// number of samples.
  double systematic_m = 0.0, random_m = 0.0, rms_m = 0.0;
  double median_m = 0.0;  // length of the error vector
  /// Half of the interval of the range that holds the middle 68 %, infinite when that holds
  /// infinity.
  double half_width_m = 0.0;
  double failures = 0.0;         // share without a finite answer, or behind a camera
  double over_20_percent = 0.0;  // share of failures and of ranges that are more than 20 % wrong
};

struct TableRow {
  const TwoViewSetup* setup = nullptr;
  Draws draws = Draws::uniform;
  Parameter parameter = Parameter::focal;
  std::size_t point = 0;  // index of scene_points_m(); their number for the worst of each column
  std::array<ErrorStatistics, all_estimators.size()> statistics;  // in the order of all_estimators

  [[nodiscard]] bool is_worst() const { return point == scene_points_m().size(); }
  [[nodiscard]] const ErrorStatistics& of(Estimator estimator) const {
    return statistics.at(static_cast<std::size_t>(estimator));
  }
};

struct MonteCarlo {
  std::size_t samples = 10000;
  std::uint64_t seed = 1;
};

/// The rows of one setup and kind of draws: for each parameter its five points, then the worst.
/// The same seed draws the same errors for each point, estimator and setup. `point_done` is called
/// after each point of each parameter.
[[nodiscard]] std::vector<TableRow> analyse(const TwoViewSetup& setup, Draws draws,
                                            const MonteCarlo& monte_carlo,
                                            const std::function<void()>& point_done);

}  // namespace gazed::lab::analysis
