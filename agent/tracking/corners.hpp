// Corners of a frame that can be found again: places whose patch has gradient in two directions
// (Shi and Tomasi, "Good features to track", CVPR 1994), spread over the frame.
//
// The measure h = l1 l2 / (l1 + l2) of the gradient matrix's eigenvalues (Noble 1988; Brown,
// Szeliski, Winder, CVPR 2005) lies between l_min / 2 and l_min and needs no square root;
// noise_variance / h is the variance of the corner's place, both axes together.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/luma.hpp"

namespace gazed::tracking {

/// A place on the level on which corners are searched, and its measure.
struct Corner {
  int column = 0, row = 0;
  float strength = 0.0F;
};

/// Owns its working buffers.
class CornerPicker {
 public:
  /// For levels of this size.
  CornerPicker(int width, int height);

  /// Picks corners of the level: the strongest of every cell of the frame, then the second
  /// strongest of every cell, and so on, until `corners` is full or none is left. `allowed(column,
  /// row)` says which may be taken. Returns how many were picked.
  template <typename Allowed>
  std::size_t pick(const LumaLevel& level, std::span<Corner> corners, Allowed&& allowed) {
    find_maxima(level);
    return select(corners,
                  [&](const Corner& corner) { return allowed(corner.column, corner.row); });
  }

  /// Cells per side of the frame, and corners kept for each.
  static constexpr int cells_per_side = 10;
  static constexpr std::size_t per_cell = 4;
  /// Two corners are at least this many samples apart on one of the axes.
  static constexpr int distance_min = 5;
  /// Side of the gradient window, samples; corners keep this far from the border.
  static constexpr int window = 7;
  static constexpr int border = 11;

 private:
  struct Cell {
    std::array<Corner, per_cell> corners;
    std::size_t count = 0;
  };

  void find_maxima(const LumaLevel& level);
  void add_products(const LumaLevel& level, int y);
  void score_row(float* scores);
  void collect(int y);
  void enter(const Corner& corner);

  template <typename Allowed>
  std::size_t select(std::span<Corner> corners, Allowed&& allowed) const {
    std::size_t count = 0;
    for (std::size_t rank = 0; rank < per_cell; ++rank) {
      for (const Cell& cell : cells_) {
        if (count == corners.size()) return count;
        if (rank >= cell.count || !allowed(cell.corners[rank])) continue;
        if (!crowded(cell.corners[rank], corners.first(count))) {
          corners[count++] = cell.corners[rank];
        }
      }
    }
    return count;
  }
  static bool crowded(const Corner& corner, std::span<const Corner> others);

  int width_, height_;
  std::array<Cell, static_cast<std::size_t>(cells_per_side* cells_per_side)> cells_;
  // Gradient products xx, xy, yy of the last `window` rows, and their sums by column.
  std::vector<std::int32_t> products_, column_sums_, scratch_;
  std::array<std::vector<float>, 3> scores_;  // for the last three rows
};

}  // namespace gazed::tracking
