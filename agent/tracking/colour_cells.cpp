#include "agent/tracking/colour_cells.hpp"

#include <algorithm>
#include <utility>

#include "agent/tracking/plane.hpp"

namespace gazed::tracking {

namespace {

// A cell of at least 4 x 4 px is the mean of 16 pixels; smaller cells are averaged with their
// neighbours.
constexpr int noisy_cell_px = 2;

// As r, g, b, 0 to 255, not clipped. YUYV is BT.601, limited range.
Eigen::Vector3f rgb_of(base::PixelFormat format, const Eigen::Vector3f& colour) {
  if (format == base::PixelFormat::rgb24) return colour;
  if (format == base::PixelFormat::grey) return Eigen::Vector3f::Constant(colour[0]);
  const float y = 1.164F * (colour[0] - 16.0F), u = colour[1] - 128.0F, v = colour[2] - 128.0F;
  return {y + 1.596F * v, y - 0.392F * u - 0.813F * v, y + 2.017F * u};
}

}  // namespace

void ColourCells::fill(const base::ImageView& image, int x_begin, int y_begin, int cell_px) {
  const int stride = std::max(1, cell_px / 4);  // at most 16 pixels per cell
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const std::size_t cell = static_cast<std::size_t>(row * side + column);
      colour[cell].setZero();
      const int x0 = x_begin + column * cell_px, y0 = y_begin + row * cell_px;
      in_frame[cell] =
          x0 >= 0 && y0 >= 0 && x0 + cell_px <= image.width_px && y0 + cell_px <= image.height_px;
      if (!in_frame[cell]) continue;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      int read = 0;
      for (int y = y0; y < y0 + cell_px; y += stride) {
        for (int x = x0; x < x0 + cell_px; x += stride, ++read) sum += colour_at(image, x, y);
      }
      colour[cell] = rgb_of(image.format, sum / static_cast<float>(read));
    }
  }
  if (cell_px <= noisy_cell_px) smooth();
}

// [1 2 1]/4 in both directions, in place, wherever all nine cells are inside the frame.
void ColourCells::smooth() {
  std::array<Eigen::Vector3f, 2 * side> rows;
  auto above = rows.begin(), here = rows.begin() + side;
  std::copy_n(colour.begin(), side, above);
  for (int row = 1; row + 1 < side; ++row) {
    const auto line = colour.begin() + row * side;
    std::copy_n(line, side, here);
    for (int column = 1; column + 1 < side; ++column) {
      const std::size_t cell = static_cast<std::size_t>(row * side + column);
      const auto all_in_frame = [&](std::size_t middle) {
        return in_frame[middle - 1] && in_frame[middle + 1];
      };
      if (!all_in_frame(cell - side) || !all_in_frame(cell + side)) continue;
      const auto three = [](auto middle) -> Eigen::Vector3f {
        return *(middle - 1) + 2.0F * *middle + *(middle + 1);
      };
      line[column] =
          (three(above + column) + 2.0F * three(here + column) + three(line + side + column)) /
          16.0F;
    }
    std::swap(above, here);
  }
}

}  // namespace gazed::tracking
