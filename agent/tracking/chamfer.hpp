// Distance transform of a square window of cells.
#pragma once

#include <array>
#include <cstdint>

#include "agent/tracking/colour_cells.hpp"

namespace gazed::tracking {

/// Three units per cell.
using CellDistances = std::array<std::int16_t, ColourCells::count>;

/// Distance from each cell to the nearest one that holds 0. All others must start above any
/// possible distance. Two passes of the 3-4 chamfer distance (Borgefors, CVGIP 34, 1986), accurate
/// to 8 %.
void measure_chamfer_distance(CellDistances& d);

}  // namespace gazed::tracking
