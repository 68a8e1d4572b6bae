// From conspicuity maps to the saliency map: S is the mean of N(intensity) and N(colour), weighted.
#pragma once

#include <cstdint>

#include "agent/saliency/feature_maps.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

/// S in Q16, from 0 to 255.
using SaliencyPlane = PlaneView<const std::int32_t>;

class SaliencySum {
 public:
  SaliencySum(double intensity_weight, double colour_weight, int map_width, int map_height);

  /// S of the two conspicuity maps, whose samples must not be negative. Owned by this object.
  /// Flicker and inhibition then modify it in place.
  PlaneView<std::int32_t> add(const ConspicuityMap& intensity, const ConspicuityMap& colour);

 private:
  void add_promoted(const ConspicuityMap& map, std::int32_t share);

  std::int32_t intensity_share_;     // Q16; both shares add up to 1
  OwnedPlane<std::int16_t> scaled_;  // one conspicuity map in 15 bits, as N needs it
  OwnedPlane<std::int32_t> saliency_;
};

}  // namespace gazed::saliency
