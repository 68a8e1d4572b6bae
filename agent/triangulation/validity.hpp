// Checks of the input: numbers that are not finite, and impossible sizes.
#pragma once

#include <optional>
#include <string>

#include "agent/geometry/rig.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/methods/linear_mmse.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// How far off the optical axis a normalised image point may be: the tangent of 89.9 degrees. No
/// pinhole lens sees that far. Beyond it, one pixel of noise is hardly any angle, and a point there
/// would be trusted without bounds.
inline constexpr double off_axis_max = 573.0;

/// The problem in words, with the value; none if all is well.
[[nodiscard]] std::optional<std::string> what_is_invalid(const TwoViews& views,
                                                         const ErrorSources& errors,
                                                         const Gate& gate);
[[nodiscard]] std::optional<std::string> what_is_invalid(const methods::Prior& prior);
[[nodiscard]] std::optional<std::string> what_is_invalid(const geometry::Uncertainty& uncertainty);

}  // namespace gazed::triangulation
