// Invalid input: numbers that are not finite, and impossible sizes.
#pragma once

#include <optional>
#include <string>

#include "agent/geometry/robot.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/methods/linear_mmse.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// The tangent of 89.9 degrees: how far off the optical axis a normalised image point may be. No
/// lens that a pinhole describes reaches that far. Beyond it one pixel of noise is hardly any
/// angle, and a point there would be trusted without bounds.
inline constexpr double off_axis_max = 573.0;

/// In words, with the value; none when all is well.
[[nodiscard]] std::optional<std::string> what_is_invalid(const TwoViews& views,
                                                         const ErrorSources& errors,
                                                         const Gate& gate);
[[nodiscard]] std::optional<std::string> what_is_invalid(const methods::Prior& prior);
[[nodiscard]] std::optional<std::string> what_is_invalid(const geometry::Uncertainty& uncertainty);

}  // namespace gazed::triangulation
