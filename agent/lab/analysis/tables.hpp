// The numbers of the error analysis as text.
#pragma once

#include <span>
#include <string>

#include "agent/lab/analysis/monte_carlo.hpp"
#include "agent/lab/analysis/sweep.hpp"

namespace gazed::lab::analysis {

/// What table 3.3 of the report prints for an estimator, mm; NaN for geometries that are not its
/// own. The replica is compared with the optimal method's column, which it explains.
[[nodiscard]] double reported_rms_mm(const TwoViewSetup& setup, Parameter parameter,
                                     Estimator estimator);

/// CSV, with a header; a line for each row and estimator. Lengths in mm, 6 significant digits.
[[nodiscard]] std::string table_csv(std::span<const TableRow> rows);

/// The worst rows of one setup and kind of draws, for a person.
[[nodiscard]] std::string table_text(std::span<const TableRow> rows, const MonteCarlo& monte_carlo);

/// CSV, with a header; a line for each row.
[[nodiscard]] std::string sweep_csv(std::span<const SweepRow> rows);

}  // namespace gazed::lab::analysis
