// How far the winner stands out, and so whether there is a salient object at all: without one "the
// results are useless" (Russcher 2011, section 2.3).
//
// The saliency map has no absolute scale, because N scales every map to its maximum: a wall that is
// slightly brighter in the middle peaks as high as a red ball. These numbers tell them apart:
//
// - sharpness: g^2 / (g^2 + 12^2), g being the largest difference between neighbouring samples of
//   the three planes, in grey levels. Shading changes slowly; an object has an edge.
//
// - concentration: share of the map's energy (the sum of S^2) within a fifth of the map's width
//   around the winner. Other maxima reduce it.
//
// - enclosure: h / (h + 16), h being how many grey levels intensity or an opponent colour must
//   change along the best way from the winner to the image's border.
//
// - object share: whether the frame's statistics are those of a frame with an object
//   (object_or_none.hpp).
//
// Profiles report and robust: distinctness = sharpness (concentration + enclosure) / 2.
// Profile surround: distinctness = sharpness x object share.
//
// The planes are those of the map's level; the full scale of an opponent plane counts as 255 grey
// levels.
#pragma once

#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/enclosure.hpp"
#include "agent/saliency/object_or_none.hpp"
#include "agent/saliency/surroundedness.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

class Distinctness {
 public:
  Distinctness(int map_width, int map_height);

  /// For profiles report and robust. [0, 1]; 0 if the map is 0.
  [[nodiscard]] double of(const SaliencyPlane& map, const Winner& winner,
                          const PlanesAtMapLevel& planes);
  /// For profile surround, and for the whole frame: needs the map before inhibition. [0, 1]; 0 if
  /// the map is 0.
  [[nodiscard]] double of(const SaliencyPlane& map, const Attention& attention,
                          const PlanesAtMapLevel& planes);

 private:
  Enclosure enclosure_;
  ObjectOrNone object_or_none_;
};

}  // namespace gazed::saliency
