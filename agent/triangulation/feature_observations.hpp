// Features of the background, which stands still: they tie the looks' head angles together,
// whatever the encoders say.
#pragma once

#include <array>
#include <cstddef>

#include "agent/geometry/camera.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// Number of looks at one target, including the first.
inline constexpr std::size_t looks_min = 2, looks_max = 16;

/// Background features followed at the same time.
inline constexpr std::size_t features_max = 100;

/// One point of the scene as the looks saw it. The pixel is NaN in a look that did not see it or
/// lost it; look 1, where it was chosen, always has one.
struct FeatureObservations {
  std::array<geometry::Pixel, looks_max> pixel;  // one per look, as seen, with lens distortion
  double sigma_px = 0.0;  // of each later pixel relative to the first, per axis

  FeatureObservations() { pixel.fill(geometry::Pixel::Constant(not_a_number)); }
};

}  // namespace gazed::triangulation
