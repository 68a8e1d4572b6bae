// Winner-take-all: the most salient place (the report, section 2.3).
#pragma once

#include "agent/geometry/camera.hpp"
#include "agent/saliency/conspicuity.hpp"

namespace gazed::saliency {

struct Winner {
  int x = 0;  // of the map's sample
  int y = 0;
  geometry::Pixel pixel =
      geometry::Pixel::Zero();  // refined, in the frame: a sample is centred on 16 (x, y)
};

/// The largest sample, the first in raster order if several are equal, refined.
[[nodiscard]] Winner find_winner(const SaliencyPlane& map);

/// Refines a local maximum: moves it on each axis, by at most half a sample, to the vertex of the
/// parabola through it and its two neighbours; not on an axis where it lies on the border.
[[nodiscard]] Winner refined_winner(const SaliencyPlane& map, int x, int y);

/// The summit reached from a sample by always going to the largest of its 8 neighbours; refined.
[[nodiscard]] Winner summit_above(const SaliencyPlane& map, int x, int y);

}  // namespace gazed::saliency
