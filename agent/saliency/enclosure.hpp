// How well a place is enclosed: how far a plane must fall (or rise) along the best way from the
// place to the image's border.
//
// An object is surrounded by something else, whereas a shaded wall, sunlight on the floor or the
// robot's own foot extends out of the picture. In topography this is the dynamics of a summit
// (Grimaud, "A new measure of contrast: the dynamics", SPIE 1769, 1992); in saliency, the
// surroundedness of Zhang and Sclaroff ("Saliency detection: a Boolean map approach", ICCV 2013),
// here for all thresholds at once.
#pragma once

#include <cstdint>
#include <vector>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

class Enclosure {
 public:
  /// For planes of this size.
  Enclosure(int width, int height);

  /// The largest of `least` (in units of the plane, not negative) and the heights of a bright and a
  /// dark summit. The summit is the extreme sample among (x, y) and its 8 neighbours.
  [[nodiscard]] std::int32_t height_at(const ConstPlane& plane, int x, int y, std::int32_t least);

 private:
  struct Candidate {
    std::int32_t value;
    std::int32_t index;
  };

  [[nodiscard]] std::int32_t pass_of(const ConstPlane& plane, std::int32_t sign, int summit);
  void consider(const ConstPlane& plane, std::int32_t sign, int index);

  std::vector<Candidate> frontier_;  // a heap, highest first
  std::vector<std::uint8_t> seen_;
};

}  // namespace gazed::saliency
