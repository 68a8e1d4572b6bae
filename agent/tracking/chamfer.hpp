// Distances in a square window of cells.
#pragma once

#include <array>
#include <cstdint>

#include "agent/tracking/colour_cells.hpp"

namespace gazed::tracking {

/// Three units a cell.
using CellDistances = std::array<std::int16_t, ColourCells::count>;

/// From each cell to the nearest that holds 0; the others must hold more than any distance. Two
/// passes of the 3-4 chamfer distance (Borgefors, CVGIP 34, 1986), which is right to 8 %.
void measure_chamfer_distance(CellDistances& d);

}  // namespace gazed::tracking
