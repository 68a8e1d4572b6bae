// Texture: how much the intensity changes from pixel to pixel of level 2, whatever its level.
//
// |4 c - left - right - above - below| / 4, low-passed to level 3: a rectified Laplacian. A printed
// cup before a plain wall of its own grey is enclosed in no plane of colours, but it is in this
// one. NSS on OSIE with such a plane of half the intensity's weight, over none: +.03; with the
// difference of levels 2 and 3 instead +.02; with |dx| and |dy| as two planes, which tell
// orientations apart, .00 to +.01.
#pragma once

#include <cstdint>

#include "agent/saliency/plane.hpp"
#include "agent/saliency/pyramid.hpp"
#include "agent/saliency/row_ring.hpp"

namespace gazed::saliency {

class Texture {
 public:
  Texture(int frame_width, int frame_height);

  /// Level 3, in units of the intensity. Borrowed from this object.
  [[nodiscard]] ConstPlane of(const Pyramid& intensity);

 private:
  AlignedSamples<std::int16_t> centre_;  // a row of level 2, its end samples repeated beyond it
  AlignedSamples<std::int16_t> change_;
  RowRing<std::int32_t> ring_;
  OwnedPlane<std::int16_t> level3_;
};

}  // namespace gazed::saliency
