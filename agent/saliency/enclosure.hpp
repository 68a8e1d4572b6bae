// How well a place is enclosed: by how much a plane must fall (or rise) on the best way from the
// place to the border of the image.
//
// An object is surrounded by something else; a shaded wall, a patch of sunlight on the floor, the
// robot's own foot run out of the picture. In topography this is the dynamics of a summit (Grimaud,
// "A new measure of contrast: the dynamics", SPIE 1769, 1992), in saliency the surroundedness of
// Zhang and Sclaroff ("Saliency detection: a Boolean map approach", ICCV 2013), taken here over all
// thresholds at once.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/saliency/plane.hpp"

namespace gazed {

class Enclosure {
 public:
  /// For planes of this size.
  Enclosure(int width, int height);

  /// In units of the plane, 0 or more; the larger of a bright and a dark summit's. The summit is
  /// the extreme sample among (x, y) and its 8 neighbours.
  [[nodiscard]] std::int32_t height_at(const ConstPlane& plane, int x, int y);

 private:
  struct Candidate {
    std::int32_t value;
    std::int32_t index;
  };

  std::int32_t summit_height(const ConstPlane& plane, std::int32_t sign, int x, int y);
  void consider(const ConstPlane& plane, std::int32_t sign, int index);

  std::vector<Candidate> frontier_;  // a heap, the highest on top
  std::vector<std::uint8_t> seen_;
};

}  // namespace gazed
