// What no answer can be made of: numbers that are none, and sizes that cannot be.
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
/// lens that a pinhole describes reaches so far, and beyond it one pixel of noise is next to no
/// angle: what is believed of such a point would be believed without bounds.
inline constexpr double off_axis_max = 573.0;

/// In words, with the value; none when all is well.
[[nodiscard]] std::optional<std::string> what_is_invalid(const TwoViews& views,
                                                         const ErrorSources& errors,
                                                         const Gate& gate);
[[nodiscard]] std::optional<std::string> what_is_invalid(const methods::Prior& prior);
[[nodiscard]] std::optional<std::string> what_is_invalid(const geometry::Uncertainty& uncertainty);

}  // namespace gazed::triangulation
