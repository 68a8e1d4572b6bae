// Pairs of looks (1, k) that can be compared with one another.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/triangulation/estimate.hpp"
#include "agent/triangulation/pair_errors.hpp"

namespace gazed::triangulation {

/// A pair that has an inverse range.
struct Pair {
  std::size_t look = 0;  // the later one
  Observation observation{};
  PointEstimate estimate;  // the pair's own, and its point
  geometry::InverseDepthPoint point{};
};

[[nodiscard]] double inverse_range(const geometry::InverseDepthPoint& point);

/// The pair (1, k), if it has an inverse range that others can be compared with.
[[nodiscard]] std::optional<Pair> comparable_pair(const Observation& observation, std::size_t look,
                                                  const PointEstimate& estimate);

/// The mean point from directions and inverse ranges.
[[nodiscard]] geometry::InverseDepthPoint weighted_mean(std::span<const Pair> pairs,
                                                        const PairVector& weights);
/// The same, by what each pair knows by itself, and not behind camera 1.
[[nodiscard]] geometry::InverseDepthPoint mean_by_information(std::span<const Pair> pairs);

/// Of two refusals, whether the first came through more of the checks.
[[nodiscard]] bool came_further(Status a, Status b);

}  // namespace gazed::triangulation
