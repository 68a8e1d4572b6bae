// gnuplot scripts that draw the error analysis from its CSV files, as SVG.
#pragma once

#include <span>
#include <string>

#include "agent/lab/analysis/monte_carlo.hpp"
#include "agent/lab/analysis/setup.hpp"

namespace gazed::lab::analysis {

/// Draws table.svg from table.csv: for each geometry RMS and median of each parameter, as bars,
/// with one kind of draws; the report's own values as crosses.
[[nodiscard]] std::string table_script(std::span<const TwoViewSetup> setups, Draws draws);

/// Draws sweep-GEOMETRY.svg from sweep.csv for each geometry: figure 3.1, five plots.
[[nodiscard]] std::string sweep_script(std::span<const TwoViewSetup> setups);

/// The files that sweep_script draws are called so.
[[nodiscard]] std::string sweep_figure(const TwoViewSetup& setup);

}  // namespace gazed::lab::analysis
