// Overexposed places: windows, lamps, what mirrors them. Their edges are the strongest of the frame
// and tell of the light behind, not of a thing before the camera.
#pragma once

#include <cstdint>

#include "agent/saliency/bit_plane.hpp"
#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

class Overexposed {
 public:
  /// `weight`, 0 to 1, of what is left of S there.
  Overexposed(double weight, int map_width, int map_height);

  /// Weakens S, in place, where the intensity of a sample or of one of its 8 neighbours says that
  /// most of the pixels around it are saturated. Both at the map's level.
  void weaken(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity);

 private:
  std::uint16_t kept_;  // Q15
  BitPlane saturated_, beside_;
};

}  // namespace gazed::saliency
