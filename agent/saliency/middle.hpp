// The middle of the object that a winner belongs to. The most salient sample is a detail of it, or
// beside it.
#pragma once

#include <cstdint>

#include "agent/geometry/camera.hpp"
#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/plane.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

/// The summit that the winner belongs to in a map without details, in the frame's pixels; inside
/// the outermost samples. `smooth` and `scratch` have the map's size.
[[nodiscard]] geometry::Pixel middle_of_object(const SaliencyPlane& map, const Winner& winner,
                                               const PlaneView<std::int32_t>& smooth,
                                               const PlaneView<std::int32_t>& scratch);

}  // namespace gazed::saliency
