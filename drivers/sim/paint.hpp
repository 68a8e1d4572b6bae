// What a pixel sees of a surface: its paint, in the light of the room's lamp.
#pragma once

#include <array>
#include <span>

#include "drivers/sim/light.hpp"
#include "drivers/sim/placed_surface.hpp"

namespace gazed::sim {

/// At a place on the surface as it is seen, where a pixel's side is `footprint_m`. A place beyond
/// the border counts as one on it.
[[nodiscard]] std::array<Light, 3> paint(const PlacedSurface& surface, const PlanePoint& point,
                                         double footprint_m);

/// Adds the mirrored lamp to one pixel of a flat surface.
void add_highlight(const PlacedSurface& surface, const SurfacePoint& point, std::span<Light> rgb);

}  // namespace gazed::sim
