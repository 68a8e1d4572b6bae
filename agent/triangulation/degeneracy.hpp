// Checks of the geometry alone: whether two looks can determine a range at all.
#pragma once

#include <optional>
#include <string>

#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// Compares the baseline with its own standard deviation and both rays with the baseline, and looks
/// for a point at its epipole. Returns the reason in words, or nothing if all is well.
[[nodiscard]] std::optional<std::string> what_is_degenerate(const TwoViews& views,
                                                            double baseline_sigma_m,
                                                            const Gate& gate);

}  // namespace gazed::triangulation
