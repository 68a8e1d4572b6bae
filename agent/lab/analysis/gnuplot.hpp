// Figures by gnuplot, called as a program.
#pragma once

#include <filesystem>

namespace gazed::lab::analysis {

enum class Gnuplot { drawn, not_installed, failed };

/// Runs gnuplot on `script`, a file of `folder`, inside of that folder. What gnuplot complains of
/// goes to standard error.
[[nodiscard]] Gnuplot run_gnuplot(const std::filesystem::path& folder,
                                  const std::filesystem::path& script);

}  // namespace gazed::lab::analysis
