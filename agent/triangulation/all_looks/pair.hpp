// What look 1 and one later look say by themselves: the initial value for the solution of all
// looks, and the reason why a look cannot be used.
#pragma once

#include <optional>
#include <span>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::triangulation::all_looks {

/// Look 1 and a later look.
struct Pair {
  PointEstimate estimate;
  // set if it is comparable with the other pairs' points
  std::optional<geometry::InverseDepthPoint> point;
};

/// The pair's point, if its inverse range is comparable with others.
[[nodiscard]] std::optional<geometry::InverseDepthPoint> comparable_point(
    const Observation& observation, const PointEstimate& estimate);

/// Mean inverse depth in look 1 over the pairs with a point that is not behind camera 1, weighted
/// by the information of each. 0 if there is none.
[[nodiscard]] double mean_inverse_depth_per_m(std::span<const Pair> pairs);

/// True if refusal `a` came later in the order of checks than `b`.
[[nodiscard]] bool came_further(Status a, Status b);

}  // namespace gazed::triangulation::all_looks
