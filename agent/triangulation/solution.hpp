// Every method's solution for two views, and how it responds to errors.
#pragma once

#include <optional>

#include "agent/triangulation/methods/method.hpp"
#include "agent/triangulation/two_view.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation {

/// None if the method has no answer (method.hpp).
[[nodiscard]] std::optional<Solution> solve(methods::Method method, const TwoViews& views,
                                            const methods::Prior& prior);

/// The same at a given point instead of the method's own, for methods that use only the images: all
/// but linear MMSE, which throws std::invalid_argument. None if the views cannot be rectified.
[[nodiscard]] std::optional<Solution> solution_at(const geometry::InverseDepthPoint& point,
                                                  methods::Method method, const TwoViews& views);

}  // namespace gazed::triangulation
