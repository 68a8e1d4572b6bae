// What stands still behind the target, as the looks saw it: background features tie the looks'
// head angles together, whatever the encoders say.
#pragma once

#include <array>
#include <cstddef>

#include "agent/geometry/camera.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// Looks at one target, with the first.
inline constexpr std::size_t looks_max = 16;

/// Background features that are followed at once.
inline constexpr std::size_t features_max = 100;

/// One point of the scene. Where a look did not see it, or lost it, its pixel is NaN; look 1, in
/// which it was chosen, sees it always.
struct FeatureObservations {
  std::array<geometry::Pixel, looks_max> pixel;  // by look; with lens distortion, as seen
  double sigma_px = 0.0;                         // of each later pixel against the first, per axis

  FeatureObservations() { pixel.fill(geometry::Pixel::Constant(not_a_number)); }
};

}  // namespace gazed::triangulation
