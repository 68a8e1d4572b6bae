// The middle of the winner's object. The most salient sample itself is often a detail of the
// object, or beside it.
#pragma once

#include <cstdint>

#include "agent/geometry/camera.hpp"
#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

/// The summit above the winner in a map without details, in the frame's pixels; never in the
/// outermost samples. `smooth` and `scratch` must have the map's size.
[[nodiscard]] geometry::Pixel middle_of_object(const SaliencyPlane& map, const Winner& winner,
                                               const PlaneView<std::int32_t>& smooth,
                                               const PlaneView<std::int32_t>& scratch);

}  // namespace gazed::saliency
