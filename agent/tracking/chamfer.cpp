#include "agent/tracking/chamfer.hpp"

namespace gazed::tracking {

void measure_chamfer_distance(CellDistances& d) {
  constexpr int side = ColourCells::side;
  const auto at = [](int column, int row) { return static_cast<std::size_t>(row * side + column); };
  const auto relax = [&](int column, int row, int from_column, int from_row, int cost) {
    if (from_column < 0 || from_column >= side || from_row < 0 || from_row >= side) return;
    std::int16_t& here = d[at(column, row)];
    const int through = d[at(from_column, from_row)] + cost;
    if (through < here) here = static_cast<std::int16_t>(through);
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      relax(column, row, column - 1, row, 3);
      relax(column, row, column - 1, row - 1, 4);
      relax(column, row, column, row - 1, 3);
      relax(column, row, column + 1, row - 1, 4);
    }
  }
  for (int row = side - 1; row >= 0; --row) {
    for (int column = side - 1; column >= 0; --column) {
      relax(column, row, column + 1, row, 3);
      relax(column, row, column + 1, row + 1, 4);
      relax(column, row, column, row + 1, 3);
      relax(column, row, column - 1, row + 1, 4);
    }
  }
}

}  // namespace gazed::tracking
