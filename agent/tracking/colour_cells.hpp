// A square window of a frame, averaged into cells.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "agent/base/image.hpp"

namespace gazed::tracking {

/// Cells of a square window, row by row: their colours (r, g, b, 0 to 255, whatever the image's
/// format), and whether they are inside the frame.
struct ColourCells {
  static constexpr int side = 48;
  static constexpr std::size_t count = static_cast<std::size_t>(side) * side;

  /// Fills the window whose first pixel is given, with cells of cell_px x cell_px pixels. Small
  /// cells are smoothed, since they contain more camera noise.
  void fill(const base::ImageView& image, int x_begin, int y_begin, int cell_px);

  std::array<Eigen::Vector3f, count> colour;
  std::array<bool, count> in_frame;

 private:
  void smooth();
};

}  // namespace gazed::tracking
