// Overexposed places: windows, lamps and their reflections. Their edges are the strongest in the
// frame, but belong to the light behind, not to an object in front of the camera.
#pragma once

#include <cstdint>

#include "agent/saliency/bit_plane.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

class Overexposed {
 public:
  /// `weight`, 0 to 1, is the share of S kept there.
  Overexposed(double weight, int map_width, int map_height);

  /// Weakens S in place, where the intensity of a sample or one of its 8 neighbours shows that most
  /// of its pixels are saturated. Both planes are at the map's level.
  void weaken(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity);

 private:
  std::uint16_t kept_;  // Q15
  BitPlane saturated_, beside_;
};

}  // namespace gazed::saliency
