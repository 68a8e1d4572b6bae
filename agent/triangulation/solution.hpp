// Every method's solution of two views, with its own response to errors.
#pragma once

#include <optional>

#include "agent/triangulation/methods/method.hpp"
#include "agent/triangulation/two_view.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation {

/// None where the method has no answer (method.hpp).
[[nodiscard]] std::optional<Solution> solve(methods::Method method, const TwoViews& views,
                                            const methods::Prior& prior);

/// The same at a given point instead of the method's own, for the methods that ask the images
/// alone: all but linear MMSE, which throws std::invalid_argument. None where nothing can be
/// rectified.
[[nodiscard]] std::optional<Solution> solution_at(const geometry::InverseDepthPoint& point,
                                                  methods::Method method, const TwoViews& views);

}  // namespace gazed::triangulation
