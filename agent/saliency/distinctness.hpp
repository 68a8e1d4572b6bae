// How far the winner stands out (SPEC 1.3).
#pragma once

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed {

/// [0, 1]; 0 for a map that is 0.
[[nodiscard]] float distinctness(const SaliencyPlane& map, const Winner& winner);

}  // namespace gazed
