// What look 1 and one later look say by themselves: where the solution of all looks starts, and why
// a look is none.
#pragma once

#include <optional>
#include <span>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::triangulation::all_looks {

/// Look 1 and a later look.
struct Pair {
  PointEstimate estimate;
  std::optional<geometry::InverseDepthPoint> point;  // where others can be compared with it
};

/// The pair's point, if it has an inverse range that others can be compared with.
[[nodiscard]] std::optional<geometry::InverseDepthPoint> comparable_point(
    const Observation& observation, const PointEstimate& estimate);

/// Mean inverse depth in look 1 of the pairs that have a point, not behind camera 1: their inverse
/// ranges by what each knows by itself. 0 when none has one.
[[nodiscard]] double mean_inverse_depth_per_m(std::span<const Pair> pairs);

/// Of two refusals, whether the first came through more of the checks.
[[nodiscard]] bool came_further(Status a, Status b);

}  // namespace gazed::triangulation::all_looks
