#include "agent/tracking/corners.hpp"

#include <algorithm>
#include <cmath>

namespace gazed::tracking {

namespace {

// Gradients are in quarter grey levels over two samples, so that 49 of their squares fit in 32
// bits.
constexpr int gradient_shift = 2;
constexpr float gradient_unit = luma_one / (1 << gradient_shift) * 2.0F;

// Below this the window is blank. Camera noise of 2 grey levels stays below 3 everywhere in a
// frame, noise of 4 below 12; plaster whose shades have a standard deviation of 2.5 levels exceeds
// it.
constexpr float strength_min = 12.0F;

}  // namespace

CornerPicker::CornerPicker(int width, int height) : width_(width), height_(height) {
  const auto row = static_cast<std::size_t>(width);
  products_.resize(3 * row * window);
  column_sums_.resize(3 * row);
  scratch_.resize(3 * row);
  for (auto& scores : scores_) scores.resize(row);
}

void CornerPicker::find_maxima(const LumaLevel& level) {
  for (Cell& cell : cells_) cell.count = 0;
  std::fill(column_sums_.begin(), column_sums_.end(), 0);
  std::fill(products_.begin(), products_.end(), 0);
  constexpr int half = window / 2;
  for (int y = 1; y + 1 < height_; ++y) {
    add_products(level, y);
    const int centre = y - half;
    if (centre < border - 1) continue;
    score_row(scores_[static_cast<std::size_t>(centre % 3)].data());
    if (centre > border && centre <= height_ - border) collect(centre - 1);
  }
}

// Replaces the row that leaves the window by row y.
void CornerPicker::add_products(const LumaLevel& level, int y) {
  const auto width = static_cast<std::size_t>(width_);
  const std::uint16_t *above = level.row(y - 1), *here = level.row(y), *below = level.row(y + 1);
  std::int32_t* xx = products_.data() + 3 * width * static_cast<std::size_t>(y % window);
  std::int32_t *xy = xx + width, *yy = xy + width;
  std::int32_t *sum_xx = column_sums_.data(), *sum_xy = sum_xx + width, *sum_yy = sum_xy + width;
  for (std::size_t x = 1; x + 1 < width; ++x) {
    const auto gx = static_cast<std::int16_t>((here[x + 1] - here[x - 1]) >> gradient_shift);
    const auto gy = static_cast<std::int16_t>((below[x] - above[x]) >> gradient_shift);
    const std::int32_t new_xx = gx * gx, new_xy = gx * gy, new_yy = gy * gy;
    sum_xx[x] += new_xx - xx[x];
    sum_xy[x] += new_xy - xy[x];
    sum_yy[x] += new_yy - yy[x];
    xx[x] = new_xx;
    xy[x] = new_xy;
    yy[x] = new_yy;
  }
}

// Computes the measure for every window in the current rows.
void CornerPicker::score_row(float* scores) {
  const auto width = static_cast<std::size_t>(width_);
  constexpr std::size_t half = window / 2;
  std::int32_t* totals = scratch_.data();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t* sums = column_sums_.data() + k * width;
    std::int32_t* total = totals + k * width;
    for (std::size_t x = half; x + half < width; ++x) {
      total[x] = (sums[x - 3] + sums[x - 2]) + (sums[x - 1] + sums[x]) +
                 (sums[x + 1] + sums[x + 2]) + sums[x + 3];
    }
  }
  constexpr float scale = 1.0F / (gradient_unit * gradient_unit);
  const std::int32_t *xx = totals, *xy = totals + width, *yy = totals + 2 * width;
  for (std::size_t x = half; x + half < width; ++x) {
    const float a = scale * static_cast<float>(xx[x]), b = scale * static_cast<float>(xy[x]),
                c = scale * static_cast<float>(yy[x]);
    scores[x] = (a * c - b * b) / (a + c + 1e-3F);
  }
}

// Collects the local maxima of row y, once the rows above and below are known.
void CornerPicker::collect(int y) {
  const float* above = scores_[static_cast<std::size_t>((y - 1) % 3)].data();
  const float* here = scores_[static_cast<std::size_t>(y % 3)].data();
  const float* below = scores_[static_cast<std::size_t>((y + 1) % 3)].data();
  for (int x = border; x < width_ - border; ++x) {
    const float s = here[x];
    if (s < strength_min || s < here[x - 1] || s <= here[x + 1] || s < above[x] || s <= below[x]) {
      continue;
    }
    if (s < above[x - 1] || s < above[x + 1] || s <= below[x - 1] || s <= below[x + 1]) continue;
    enter({x, y, s});
  }
}

// Keeps each cell's strongest corners, sorted, at least distance_min apart.
void CornerPicker::enter(const Corner& corner) {
  const int column = corner.column * cells_per_side / width_;
  const int row = corner.row * cells_per_side / height_;
  Cell& cell = cells_[static_cast<std::size_t>(row * cells_per_side + column)];
  std::size_t place = 0;
  while (place < cell.count && cell.corners[place].strength >= corner.strength) ++place;
  if (place == per_cell || crowded(corner, {cell.corners.data(), place})) return;
  std::size_t kept = place;  // drop weaker ones that are too near
  std::array<Corner, per_cell> weaker{};
  const std::size_t weaker_count = cell.count - place;
  std::copy_n(cell.corners.begin() + static_cast<std::ptrdiff_t>(place), weaker_count,
              weaker.begin());
  cell.corners[kept++] = corner;
  for (std::size_t i = 0; i < weaker_count && kept < per_cell; ++i) {
    if (!crowded(weaker[i], {&corner, 1})) cell.corners[kept++] = weaker[i];
  }
  cell.count = kept;
}

bool CornerPicker::crowded(const Corner& corner, std::span<const Corner> others) {
  return std::any_of(others.begin(), others.end(), [&](const Corner& other) {
    return std::max(std::abs(corner.column - other.column), std::abs(corner.row - other.row)) <
           distance_min;
  });
}

}  // namespace gazed::tracking
