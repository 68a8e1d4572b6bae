// How far the winner stands out, and so whether there is a salient object at all: without one "the
// results are useless" (Russcher 2011, section 2.3).
//
// N and the maxima it scales to leave no absolute measure in the saliency map: a wall that is a
// little brighter in the middle has a winner as high as a red ball has. Numbers that tell them
// apart:
//
//   sharpness      g^2/(g^2 + 12^2): g the largest difference between neighbouring samples of the
//                  three planes, in grey levels: shading changes slowly, an object has an edge
//   concentration  share of the map's energy (the sum of S^2) near the winner, within a fifth of
//                  the map's width: other maxima, near or far, take from it
//   enclosure      h/(h + 16): the intensity or an opponent colour must change by h grey levels on
//                  the best way from the winner to the border of the image
//   object share   are the frame's statistics those of one with an object (object_or_none.hpp)?
//
//   report, robust  distinctness = sharpness (concentration + enclosure) / 2
//   surround        distinctness = sharpness x object share
//
// The planes are those of the map's level; full scale of an opponent plane counts as 255 grey
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

  /// Of profiles report and robust. [0, 1]; 0 for a map that is 0.
  [[nodiscard]] double of(const SaliencyPlane& map, const Winner& winner,
                          const PlanesAtMapLevel& planes);
  /// Of profile surround, and of the whole frame: the map as it is before anything is inhibited.
  /// Likewise.
  [[nodiscard]] double of(const SaliencyPlane& map, const Attention& attention,
                          const PlanesAtMapLevel& planes);

 private:
  Enclosure enclosure_;
  ObjectOrNone object_or_none_;
};

}  // namespace gazed::saliency
