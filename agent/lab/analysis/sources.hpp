// What each source of error that a robot's profile names does to a range, by itself.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gazed::lab::analysis {

inline constexpr std::size_t source_points = 3;

struct SourceRow {
  std::string_view source;
  double sigma = 0.0;  // as shown, in `unit`
  std::string_view unit;
  /// Of the range, as estimate_point propagates it (optimal method), at each point; the first of
  /// them is the nearest.
  std::array<double, source_points> relative_sigma{};
};

/// The move of the setup nao-v6 with the sigmas of its profile, the greatest effect on the farthest
/// point first; the last row is all of them together. The points: at 0.3, 0.75 and 1.5 m.
[[nodiscard]] std::vector<SourceRow> nao_sources();

/// CSV, with a header; a line for each row.
[[nodiscard]] std::string sources_csv(std::span<const SourceRow> rows);

/// For a person, in % of the range.
[[nodiscard]] std::string sources_text(std::span<const SourceRow> rows);

}  // namespace gazed::lab::analysis
