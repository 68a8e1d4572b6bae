// Checks of the geometry alone: whether two looks can say anything about a range.
#pragma once

#include <optional>
#include <string>

#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// The baseline against its own standard deviation, both rays against the baseline, a point at its
/// epipole. In words; none when all is well.
[[nodiscard]] std::optional<std::string> what_is_degenerate(const TwoViews& views,
                                                            double baseline_sigma_m,
                                                            const Gate& gate);

}  // namespace gazed::triangulation
