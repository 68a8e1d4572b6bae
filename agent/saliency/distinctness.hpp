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
//   q              p m^2 r: p and m the peak and the mean of the absolute attention
//                  (surroundedness.hpp), r = (2 + e)/(2 + f), e and f the largest differences of
//                  neighbours, in grey levels, where S is above half of the winner's and elsewhere
//
//   report, robust  distinctness = sharpness (concentration + enclosure) / 2
//   surround        distinctness = sharpness q^2 / (q^2 + 2.5e-5)
//
// In log p, log m and log r the last one is a logistic regression, objects against none. An area A
// that is surrounded in an interval adds up to 1/sqrt(A) to p and sqrt(A) to the sum behind m: p m
// counts intervals whatever the area, and m once more favours what fills more of the frame; r
// makes up for that where a small thing is alone on a wall.
//
// The planes are those of the map's level; full scale of an opponent plane counts as 255 grey
// levels.
#pragma once

#include <array>

#include "agent/saliency/bit_plane.hpp"
#include "agent/saliency/conspicuity.hpp"
#include "agent/saliency/enclosure.hpp"
#include "agent/saliency/surroundedness.hpp"
#include "agent/saliency/winner.hpp"

namespace gazed::saliency {

/// Intensity, red-green, blue-yellow at the map's level.
using PlanesAtMapLevel = std::array<ConstPlane, 3>;

class Distinctness {
 public:
  Distinctness(int map_width, int map_height);

  /// Of profiles report and robust. [0, 1]; 0 for a map that is 0.
  [[nodiscard]] double of(const SaliencyPlane& map, const Winner& winner,
                          const PlanesAtMapLevel& planes);
  /// Of profile surround, and of the whole frame: the map as it is before anything is inhibited.
  [[nodiscard]] double of(const SaliencyPlane& map, const Attention& attention,
                          const PlanesAtMapLevel& planes);

 private:
  /// The largest differences of neighbours, in grey levels, where S is high and elsewhere.
  struct Edges {
    double inside = 0.0, outside = 0.0;
  };

  [[nodiscard]] Edges edges(const SaliencyPlane& map, const PlanesAtMapLevel& planes);

  Enclosure enclosure_;
  BitPlane strong_, around_strong_;  // where S is above half of the winner's, and a margin
};

}  // namespace gazed::saliency
