#include "agent/tracking/object.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "agent/tracking/highlight.hpp"
#include "agent/tracking/plane.hpp"

namespace gazed::tracking {

namespace {

constexpr int cell_shift_max = 3;
constexpr int rim_cells = 2;  // width of the rim that represents the surroundings

// Of the frame's shorter side. Nothing reaches the rim of a window that is larger than the frame:
// at 320x240 a wall was an object.
constexpr double window_share_max = 0.8;

// The saliency winner is accurate to a map cell, 16 px; the object must be within this distance.
constexpr double salient_error_px = 20.0;

// Camera noise of 5 grey levels, averaged over three channels, stays below this.
constexpr float contrast_min = 12.0F;
// The quantile of the rim's colour distances that counts as its own contrast: up to a fifth of the
// rim may be something else.
constexpr double rim_quantile = 0.8;
constexpr float rim_factor = 2.5F;
// Threshold as a share of the object's contrast; half would cut off thin or slightly blurred parts.
constexpr float outline_share = 0.4F;
constexpr int area_min_cells = 9;
// As a share of the floor, the contrast that the rim has by itself.
constexpr float unlike_rim_share = 0.7F;

// Seeds of areas of one colour lie on a grid with this spacing and this many steps to each side.
constexpr int seed_step_px = 6;
constexpr int seed_step_cells = 3;
constexpr int seed_steps = 3;

// Cells to keep from the window's rim, so that both sides of an outline are inside.
constexpr int far_reach = HighlightJudge::far_cells;

float quantile(std::span<float> values, double share) {
  const auto nth = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + nth, values.end());
  return values[static_cast<std::size_t>(nth)];
}

}  // namespace

bool ObjectMask::segment(const base::ImageView& image, const geometry::Pixel& salient) {
  candidates_.clear();
  const auto largest_px =
      static_cast<int>(window_share_max * std::min(image.width_px, image.height_px));
  for (int cell_shift = 0; cell_shift <= cell_shift_max && cells << cell_shift <= largest_px;
       ++cell_shift) {
    place_window(salient, cell_shift);
    cells_.fill(image, origin_x_, origin_y_, cell_px());
    find_areas_of_one_colour(salient);
    find_area_unlike_rim(salient);
  }
  const std::optional<Candidate> first = candidates_.best();
  if (!first) return false;
  std::optional<Candidate> best = first;
  mark(*best, image, salient, Holes::of_other_colours);
  while (is_highlight()) {
    candidates_.keep_around(*best);
    best = candidates_.best();
    mark(best ? *best : *first, image, salient, Holes::all);
    if (!best) break;  // a bright thing out of focus, with no object around it
  }
  return true;
}

bool ObjectMask::take_mark_on(const ObjectMask& other, const base::ImageView& image,
                              const geometry::Pixel& salient) {
  const std::optional<Candidate>& found = other.candidates_.mark();
  if (!found) return false;
  mark(*found, image, salient, Holes::of_other_colours);
  return !is_highlight();
}

void ObjectMask::mark(const Candidate& candidate, const base::ImageView& image,
                      const geometry::Pixel& salient, Holes filled) {
  place_window(salient, candidate.cell_shift);
  cells_.fill(image, origin_x_, origin_y_, cell_px());
  if (candidate.of_one_colour) {
    flood_.mark(cells_, candidate.area, filled, object_);
  } else if (grow_unlike_rim(salient) && filled == Holes::all) {
    flood_.fill_holes(cells_, filled, object_);
  }
  measure_distances();
}

bool ObjectMask::is_highlight() const {
  HighlightJudge judge;
  for_outline_cells([&](int column, int row, const Eigen::Vector2d& outward) {
    if (std::min({column, row, cells - 1 - column, cells - 1 - row}) < far_reach) return;
    const auto at = [&](int steps) {
      return index_of(column + static_cast<int>(std::lround(steps * outward.x())),
                      row + static_cast<int>(std::lround(steps * outward.y())));
    };
    constexpr int near = HighlightJudge::near_cells, far = HighlightJudge::far_cells;
    if (!cells_.in_frame[at(far)] || !cells_.in_frame[at(1 - far)]) return;
    judge.add({cells_.colour[at(1 - far)], cells_.colour[at(1 - near)], cells_.colour[at(near)],
               cells_.colour[at(far)]});
  });
  return judge.is_highlight();
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
  measure_distances();
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

// Seeds lie around the salient place, which may be just off a small object or on a mark.
void ObjectMask::find_areas_of_one_colour(const geometry::Pixel& salient) {
  const int step = std::max(seed_step_cells, seed_step_px >> cell_shift_);
  const int reach = seed_steps * step;
  for (int dy = -reach; dy <= reach; dy += step) {
    for (int dx = -reach; dx <= reach; dx += step) {
      const int column = cells / 2 + dx, row = cells / 2 + dy;
      if (!cells_.in_frame[index_of(column, row)]) continue;
      const auto area = flood_.area_around(cells_, index_of(column, row));
      if (!area) continue;
      Candidate found;
      found.of_one_colour = true;
      found.area = *area;
      found.contrast = area->contrast;
      found.clearness = area->clearness;
      found.area_px = area->hull_cells * static_cast<float>(cell_px() * cell_px());
      found.solid_share = static_cast<float>(area->cells) / area->hull_cells;
      found.box_px = box_px(area->left, area->top, area->right, area->bottom);
      add(found, salient);
    }
  }
}

void ObjectMask::add(Candidate& candidate, const geometry::Pixel& salient) {
  candidate.cell_shift = cell_shift_;
  candidate.salient_px = salient.cast<float>();
  candidates_.add(candidate);
}

void ObjectMask::find_area_unlike_rim(const geometry::Pixel& salient) {
  if (!grow_unlike_rim(salient)) return;
  Candidate found;
  found.contrast = contrast_seen_;
  found.clearness = std::log(contrast_seen_ / (unlike_rim_share * contrast_floor_));
  found.area_px = static_cast<float>(area_cells_ * cell_px() * cell_px());
  int left = cells, top = cells, right = -1, bottom = -1;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      if (!object_[index_of(column, row)]) continue;
      left = std::min(left, column), right = std::max(right, column);
      top = std::min(top, row), bottom = std::max(bottom, row);
    }
  }
  found.box_px = box_px(left, top, right, bottom);
  add(found, salient);
}

Eigen::AlignedBox2f ObjectMask::box_px(int left, int top, int right, int bottom) const {
  const Eigen::Vector2f half_cell = Eigen::Vector2f::Constant(0.5F * static_cast<float>(cell_px()));
  return {centre_px(left, top).cast<float>() - half_cell,
          centre_px(right, bottom).cast<float>() + half_cell};
}

bool ObjectMask::grow_unlike_rim(const geometry::Pixel& salient) {
  if (!measure_contrast()) return false;
  // The seed is where the contrast, averaged over 3x3 cells, is largest near the salient place.
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
  return peak >= contrast_floor_ &&
         grow_from(seed, std::max(contrast_floor_, outline_share * peak));
}

// The rim consists of the window's outermost cells, except where the frame's border cuts it off.
bool ObjectMask::measure_contrast() {
  std::array<std::uint16_t, 8 * cells> rim;
  std::size_t rim_size = 0;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const int to_rim = std::min({column, row, cells - 1 - column, cells - 1 - row});
      if (to_rim < rim_cells && cells_.in_frame[index_of(column, row)]) {
        rim[rim_size++] = static_cast<std::uint16_t>(index_of(column, row));
      }
    }
  }
  if (rim_size < static_cast<std::size_t>(cells)) return false;  // less than half a side

  const std::span<float> scratch(rim_.data(), rim_size);
  Eigen::Vector3f background;
  for (int channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < rim_size; ++i) scratch[i] = cells_.colour[rim[i]][channel];
    background[channel] = quantile(scratch, 0.5);
  }
  for (std::size_t i = 0; i < cell_count; ++i) {
    contrast_[i] = cells_.in_frame[i] ? (cells_.colour[i] - background).norm() : 0.0F;
  }
  for (std::size_t i = 0; i < rim_size; ++i) scratch[i] = contrast_[rim[i]];
  contrast_floor_ = std::max(contrast_min, rim_factor * quantile(scratch, rim_quantile));
  return true;
}

// Flood fill. Returns false if the area is too small or reaches the window's edge inside the frame.
bool ObjectMask::grow_from(std::size_t seed, float threshold) {
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
      const std::size_t next = index_of(column + dx, row + dy);
      if (cells_.in_frame[next]) visit(next);
    }
  }
  area_cells_ = area;
  return area >= area_min_cells;
}

}  // namespace gazed::tracking
