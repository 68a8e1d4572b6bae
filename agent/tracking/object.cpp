#include "agent/tracking/object.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "agent/tracking/plane.hpp"

namespace gazed::tracking {

namespace {

// A larger area is the object, and the smaller one a mark on it, when it stands out that much more
// (a ring printed on a disc against the disc on its wall) and is that much larger; what stands on a
// table differs from it about as much as the table from the wall.
constexpr float encloses_contrast = 2.5F;
constexpr float encloses_area = 2.0F;

constexpr int cells = ObjectMask::cells;
constexpr int cell_shift_max = 3;
constexpr int rim_cells = 2;  // width of the rim that says what the surroundings look like

// The saliency winner is good to a map cell, 16 px; the object must reach that close.
constexpr double salient_error_px = 20.0;

// Camera noise of 5 grey levels in a mean over three channels stays below.
constexpr float contrast_min = 12.0F;
// Of the rim's colour distances the 80th percentile: up to a fifth of the rim may be something
// else.
constexpr double rim_quantile = 0.8;
constexpr float rim_factor = 2.5F;
// Of the object's contrast; half would cut thin or slightly blurred parts off.
constexpr float outline_share = 0.4F;
constexpr int area_min_cells = 9;
constexpr std::int16_t unreachable = std::numeric_limits<std::int16_t>::max() / 2;

constexpr std::size_t index_of(int column, int row) {
  return static_cast<std::size_t>(row * cells + column);
}

float quantile(std::span<float> values, double share) {
  const auto nth = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + nth, values.end());
  return values[static_cast<std::size_t>(nth)];
}

// Two passes of the 3-4 chamfer distance (Borgefors, CVGIP 34, 1986); sources hold 0.
void chamfer(std::array<std::int16_t, cells * cells>& d) {
  const auto relax = [&](int column, int row, int from_column, int from_row, int cost) {
    if (from_column < 0 || from_column >= cells || from_row < 0 || from_row >= cells) return;
    std::int16_t& here = d[index_of(column, row)];
    const int through = d[index_of(from_column, from_row)] + cost;
    if (through < here) here = static_cast<std::int16_t>(through);
  };
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      relax(column, row, column - 1, row, 3);
      relax(column, row, column - 1, row - 1, 4);
      relax(column, row, column, row - 1, 3);
      relax(column, row, column + 1, row - 1, 4);
    }
  }
  for (int row = cells - 1; row >= 0; --row) {
    for (int column = cells - 1; column >= 0; --column) {
      relax(column, row, column + 1, row, 3);
      relax(column, row, column + 1, row + 1, 4);
      relax(column, row, column, row + 1, 3);
      relax(column, row, column - 1, row + 1, 4);
    }
  }
}

}  // namespace

bool ObjectMask::segment(const base::ImageView& image, const geometry::Pixel& salient) {
  int chosen_shift = -1, last_shift = -1;
  float chosen_contrast = 0.0F, chosen_area_px = 0.0F;
  for (int cell_shift = 0; cell_shift <= cell_shift_max; ++cell_shift) {
    place_window(salient, cell_shift);
    last_shift = cell_shift;
    if (!segment_window(image, salient)) continue;
    const float area_px =
        static_cast<float>(area_cells_) * static_cast<float>(cell_px() * cell_px());
    const bool encloses = contrast_seen_ > encloses_contrast * chosen_contrast &&
                          area_px > encloses_area * chosen_area_px;
    if (chosen_shift >= 0 && !encloses) continue;
    chosen_shift = cell_shift;
    chosen_contrast = contrast_seen_;
    chosen_area_px = area_px;
  }
  if (chosen_shift < 0) return false;
  if (chosen_shift == last_shift) return true;
  place_window(salient, chosen_shift);
  return segment_window(image, salient);
}

void ObjectMask::take_square(const base::ImageView& image, const geometry::Pixel& centre,
                             int half_size_px) {
  int cell_shift = 0;
  while (cell_shift < cell_shift_max && (cells / 2 - 1) << cell_shift < half_size_px) ++cell_shift;
  place_window(centre, cell_shift);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double reach = (centre_px(column, row) - centre).lpNorm<Eigen::Infinity>();
      object_[index_of(column, row)] = reach <= half_size_px && in_frame(image, column, row);
    }
  }
  measure_distances(image);
}

void ObjectMask::place_window(const geometry::Pixel& centre, int cell_shift) {
  cell_shift_ = cell_shift;
  origin_x_ = static_cast<int>(std::lround(centre.x())) - cells / 2 * cell_px();
  origin_y_ = static_cast<int>(std::lround(centre.y())) - cells / 2 * cell_px();
}

bool ObjectMask::in_frame(const base::ImageView& image, int column, int row) const {
  const int x = origin_x_ + column * cell_px(), y = origin_y_ + row * cell_px();
  return x >= 0 && y >= 0 && x + cell_px() <= image.width_px && y + cell_px() <= image.height_px;
}

geometry::Pixel ObjectMask::centre_px(int column, int row) const {
  return {origin_x_ + column * cell_px() + 0.5 * (cell_px() - 1),
          origin_y_ + row * cell_px() + 0.5 * (cell_px() - 1)};
}

bool ObjectMask::segment_window(const base::ImageView& image, const geometry::Pixel& salient) {
  fill_cells(image);
  if (!measure_contrast(image)) return false;
  // The seed: where the contrast, averaged over 3x3 cells, is largest near the salient place.
  float best = 0.0F;
  std::size_t seed = 0;
  for (int row = 1; row + 1 < cells; ++row) {
    for (int column = 1; column + 1 < cells; ++column) {
      if ((centre_px(column, row) - salient).norm() > salient_error_px) continue;
      float sum = 0.0F;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) sum += contrast_[index_of(column + dx, row + dy)];
      }
      if (sum > best) {
        best = sum;
        seed = index_of(column, row);
      }
    }
  }
  const float peak = best / 9.0F;
  contrast_seen_ = peak;
  if (peak < contrast_floor_) return false;
  if (!grow_from(seed, std::max(contrast_floor_, outline_share * peak), image)) return false;
  measure_distances(image);
  return true;
}

void ObjectMask::fill_cells(const base::ImageView& image) {
  const int stride = std::max(1, cell_px() / 4);  // at most 16 pixels a cell
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      if (!in_frame(image, column, row)) continue;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      const int x0 = origin_x_ + column * cell_px(), y0 = origin_y_ + row * cell_px();
      int count = 0;
      for (int y = y0; y < y0 + cell_px(); y += stride) {
        for (int x = x0; x < x0 + cell_px(); x += stride, ++count) sum += colour_at(image, x, y);
      }
      colour_[index_of(column, row)] = sum / static_cast<float>(count);
    }
  }
}

// The rim is the window's outermost cells, where it is not cut by the frame.
bool ObjectMask::measure_contrast(const base::ImageView& image) {
  std::array<std::uint16_t, 8 * cells> rim;
  std::size_t rim_size = 0;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const int to_rim = std::min({column, row, cells - 1 - column, cells - 1 - row});
      if (to_rim < rim_cells && in_frame(image, column, row)) {
        rim[rim_size++] = static_cast<std::uint16_t>(index_of(column, row));
      }
    }
  }
  if (rim_size < static_cast<std::size_t>(cells)) return false;  // less than half a side

  const std::span<float> scratch(rim_.data(), rim_size);
  Eigen::Vector3f background;
  for (int channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < rim_size; ++i) scratch[i] = colour_[rim[i]][channel];
    background[channel] = quantile(scratch, 0.5);
  }
  for (std::size_t i = 0; i < cell_count; ++i) {
    const int column = static_cast<int>(i) % cells, row = static_cast<int>(i) / cells;
    contrast_[i] = in_frame(image, column, row) ? (colour_[i] - background).norm() : 0.0F;
  }
  for (std::size_t i = 0; i < rim_size; ++i) scratch[i] = contrast_[rim[i]];
  contrast_floor_ = std::max(contrast_min, rim_factor * quantile(scratch, rim_quantile));
  return true;
}

// Flood fill. False when the area is too small or reaches the window's edge inside the frame.
bool ObjectMask::grow_from(std::size_t seed, float threshold, const base::ImageView& image) {
  object_.fill(false);
  std::size_t on_stack = 0;
  int area = 0;
  const auto visit = [&](std::size_t cell) {
    if (object_[cell] || contrast_[cell] < threshold) return;
    object_[cell] = true;
    stack_[on_stack++] = static_cast<std::uint16_t>(cell);
  };
  visit(seed);
  while (on_stack > 0) {
    const std::size_t cell = stack_[--on_stack];
    const int column = static_cast<int>(cell) % cells, row = static_cast<int>(cell) / cells;
    ++area;
    if (column == 0 || row == 0 || column == cells - 1 || row == cells - 1) return false;
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (in_frame(image, column + dx, row + dy)) visit(index_of(column + dx, row + dy));
    }
  }
  area_cells_ = area;
  return area >= area_min_cells;
}

void ObjectMask::measure_distances(const base::ImageView& image) {
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const std::size_t i = index_of(column, row);
      outside_[i] = object_[i] ? std::int16_t{0} : unreachable;
      inside_[i] = object_[i] && in_frame(image, column, row) ? unreachable : std::int16_t{0};
    }
  }
  chamfer(outside_);
  chamfer(inside_);
}

geometry::Pixel ObjectMask::interior_point() const {
  geometry::Pixel sum = geometry::Pixel::Zero();
  int area = 0;
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < cell_count; ++i) {
    if (!object_[i]) continue;
    sum += centre_px(static_cast<int>(i) % cells, static_cast<int>(i) / cells);
    ++area;
    if (inside_[i] > inside_[deepest]) deepest = i;
  }
  const geometry::Pixel centroid = sum / std::max(area, 1);
  const auto column = static_cast<int>(std::floor((centroid.x() - origin_x_ + 0.5) / cell_px()));
  const auto row = static_cast<int>(std::floor((centroid.y() - origin_y_ + 0.5) / cell_px()));
  if (2 * inside_[index_of(column, row)] >= inside_[deepest]) return centroid;
  return centre_px(static_cast<int>(deepest) % cells, static_cast<int>(deepest) / cells);
}

double ObjectMask::half_size_px(const geometry::Pixel& centre) const {
  double half_size = 0.0;
  for (std::size_t i = 0; i < cell_count; ++i) {
    if (!object_[i]) continue;
    const geometry::Pixel at = centre_px(static_cast<int>(i) % cells, static_cast<int>(i) / cells);
    half_size = std::max(half_size, (at - centre).lpNorm<Eigen::Infinity>() + 0.5 * cell_px());
  }
  return half_size;
}

}  // namespace gazed::tracking
