#include "agent/tracking/own_colour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gazed::tracking {

namespace {

constexpr int window_side = ColourCells::side;

// Weight of a difference along the line of shading: a ball's dark side is half as bright as its lit
// one.
constexpr float shading_share = 0.3F;
// Weight of the step from one cell to the next: on a shaded ball it may be large.
constexpr float step_weight = 0.6F;
// Darker colours have no reliable direction.
constexpr float dark_brightness = 40.0F;

// The lowest level of the staircase: camera noise of 5 grey levels, averaged over 3x3 cells,
// connects a plain area at this level.
constexpr float noise_level = 8.0F;
// An area counts as unchanged while it grows by less than this factor: edges are blurred.
constexpr float standing_growth = 1.2F;
// An area behind a mark is larger than the mark by at least this factor.
constexpr float behind_mark_growth = 1.3F;
// The ratio of levels that makes an outline, and the contrast that it must have.
constexpr float ratio_min = 1.7F;
constexpr float spill_level_min = 14.0F;
// The outermost cells are not smoothed like the others.
constexpr int rim = 2;
constexpr int flood_min_cells = 9;
// Share of the hull that the area must fill; with less it is a spill through clutter.
constexpr float solid_share_min = 0.3F;
// A hole is filled if its colour differs from that of the surroundings by at least this.
constexpr float hole_contrast_min = 30.0F;

constexpr std::size_t cell_at(int column, int row) {
  return static_cast<std::size_t>(row * window_side + column);
}

// Median of the 3x3 cells around a cell, per channel: edges and specks have no influence.
Eigen::Vector3f median_around(const ColourCells& cells, std::size_t cell) {
  const int column = static_cast<int>(cell) % window_side,
            row = static_cast<int>(cell) / window_side;
  Eigen::Vector3f median;
  for (int channel = 0; channel < 3; ++channel) {
    std::array<float, 9> values;
    std::size_t n = 0;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, window_side - 1); ++y) {
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, window_side - 1); ++x) {
        if (cells.in_frame[cell_at(x, y)]) values[n++] = cells.colour[cell_at(x, y)][channel];
      }
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(n));
    median[channel] = *middle;
  }
  return median;
}

int level_of(float difference) {
  return std::min(ColourFlood::levels - 1, static_cast<int>(difference / ColourFlood::level_step));
}

template <class Visit>
void for_neighbours(std::size_t cell, const Visit& visit) {
  const int column = static_cast<int>(cell) % window_side,
            row = static_cast<int>(cell) / window_side;
  if (column > 0) visit(cell - 1);
  if (column + 1 < window_side) visit(cell + 1);
  if (row > 0) visit(cell - window_side);
  if (row + 1 < window_side) visit(cell + window_side);
}

// The smallest octagon around some cells, with sides along the axes and the diagonals.
class Hull {
 public:
  void include(int column, int row) {
    const std::array<int, 4> along{column, row, column + row, column - row};
    for (std::size_t k = 0; k < 4; ++k) {
      low[k] = std::min(low[k], along[k]);
      high[k] = std::max(high[k], along[k]);
    }
  }

  /// Area of the bounding box without its four cut corners, cells.
  [[nodiscard]] float cells() const {
    if (high[0] < low[0]) return 0.0F;
    const auto width = static_cast<float>(high[0] - low[0] + 1);
    const auto height = static_cast<float>(high[1] - low[1] + 1);
    const auto corner = [](int cut) { return 0.5F * static_cast<float>(cut * (cut + 1)); };
    return width * height - corner(low[2] - (low[0] + low[1])) -
           corner(high[0] + high[1] - high[2]) - corner(low[3] - (low[0] - high[1])) -
           corner(high[0] - low[1] - high[3]);
  }

  std::array<int, 4> low{window_side, window_side, 2 * window_side, window_side};
  std::array<int, 4> high{-1, -1, -1, -window_side};
};

}  // namespace

ColourDistance::ColourDistance(const Eigen::Vector3f& colour)
    : colour_(colour), along_(Eigen::Vector3f::Zero()) {
  const float brightness = colour.norm();
  if (brightness > dark_brightness)
    along_ = std::sqrt(1.0F - shading_share * shading_share) / brightness * colour;
}

// Returns the level at which the flood spills over the window's rim, or one above the highest.
int ColourFlood::rise(const ColourCells& cells, std::size_t seed, int highest_level,
                      float own_difference) {
  const ColourDistance distance(median_around(cells, seed));
  first_.fill(-1);
  visited_.fill(false);
  level_of_.fill(levels);
  std::int16_t entries = 0;
  const auto add = [&](std::size_t cell, int level) {
    if (level >= level_of_[cell]) return;
    level_of_[cell] = static_cast<std::uint8_t>(level);
    std::int16_t& first = first_[static_cast<std::size_t>(level)];
    entries_[static_cast<std::size_t>(entries)] = {static_cast<std::uint16_t>(cell), first};
    first = entries++;
  };
  add(seed, 0);
  int area = 0;
  Hull hull, own_hull;
  for (int level = 0; level <= highest_level; ++level) {
    std::int16_t& first = first_[static_cast<std::size_t>(level)];
    while (first >= 0) {
      const Entry entry = entries_[static_cast<std::size_t>(first)];
      first = entry.next;
      const std::size_t cell = entry.cell;
      if (visited_[cell]) continue;
      visited_[cell] = true;
      ++area;
      const int column = static_cast<int>(cell) % window_side;
      const int row = static_cast<int>(cell) / window_side;
      if (std::min({column, row, window_side - 1 - column, window_side - 1 - row}) < rim) {
        return level;
      }
      const Eigen::Vector3f& colour = cells.colour[cell];
      hull.include(column, row);
      if (distance.to(colour) <= own_difference) own_hull.include(column, row);
      for_neighbours(cell, [&](std::size_t next) {
        if (visited_[next] || !cells.in_frame[next]) return;
        const float step = step_weight * (cells.colour[next] - colour).norm();
        add(next, std::max(level, level_of(std::max(step, distance.to(cells.colour[next])))));
      });
    }
    stages_[static_cast<std::size_t>(level)] = {
        area, hull.cells(), own_hull.cells(), hull.low[0], hull.high[0], hull.low[1], hull.high[1]};
  }
  return highest_level + 1;
}

std::optional<ColourArea> ColourFlood::area_around(const ColourCells& cells, std::size_t seed) {
  const int spill = rise(cells, seed, levels - 1, std::numeric_limits<float>::max());
  ColourArea best;
  int top = 0;
  for (int bottom = 0; bottom < spill; ++bottom) {
    const Stage& from = stages_[static_cast<std::size_t>(bottom)];
    while (top < spill &&
           stages_[static_cast<std::size_t>(top)].hull_cells <= standing_growth * from.hull_cells) {
      ++top;
    }
    if (from.cells < flood_min_cells ||
        static_cast<float>(from.cells) < solid_share_min * from.hull_cells) {
      continue;
    }
    const float low = std::max(noise_level, level_step * static_cast<float>(bottom + 1));
    const float high = level_step * static_cast<float>(top);
    if (high < spill_level_min || high < ratio_min * low) continue;
    const float clearness = std::log(high / low);
    if (clearness <= best.clearness) continue;
    best = {static_cast<std::uint16_t>(seed),
            0.5F * (low + high),
            high,
            clearness,
            from.hull_cells,
            from.cells,
            from.left,
            from.right,
            from.top,
            from.bottom};
  }
  if (!(best.clearness > 0.0F)) return std::nullopt;
  look_behind_marks(cells, best);
  return best;
}

// If the flood has drowned everything around the area and finds the area's own colour on all sides,
// then what it drowned is a mark.
void ColourFlood::look_behind_marks(const ColourCells& cells, ColourArea& area) {
  const float low = area.contrast * std::exp(-area.clearness);
  const int spill = rise(cells, area.seed, levels - 1, area.level);
  const float smallest = behind_mark_growth * area.hull_cells;
  for (int level = level_of(area.contrast); level < spill; ++level) {
    const Stage& stage = stages_[static_cast<std::size_t>(level)];
    if (stage.hull_cells < smallest || stage.hull_cells > standing_growth * stage.own_hull_cells ||
        static_cast<float>(stage.cells) < solid_share_min * stage.hull_cells) {
      continue;
    }
    const float high = level_step * static_cast<float>(level + 1);
    area = {area.seed,
            0.5F * (area.contrast + high),
            high,
            std::log(high / low),
            stage.hull_cells,
            stage.cells,
            stage.left,
            stage.right,
            stage.top,
            stage.bottom};
  }
}

void ColourFlood::mark(const ColourCells& cells, const ColourArea& area, Holes filled,
                       std::array<bool, ColourCells::count>& object) {
  rise(cells, area.seed, level_of(area.level), 0.0F);
  object = visited_;
  fill_holes(cells, filled, object);
}

void ColourFlood::fill_holes(const ColourCells& cells, Holes filled,
                             std::array<bool, ColourCells::count>& object) {
  std::size_t on_stack = 0;
  visited_.fill(false);
  const auto visit = [&](std::size_t cell) {
    if (visited_[cell] || object[cell]) return;
    visited_[cell] = true;
    stack_[on_stack++] = static_cast<std::uint16_t>(cell);
  };
  for (int i = 0; i < window_side; ++i) {
    for (const std::size_t cell :
         {cell_at(i, 0), cell_at(i, window_side - 1), cell_at(0, i), cell_at(window_side - 1, i)}) {
      visit(cell);
    }
  }
  // Finds the outside, and the mean colour of the outside cells two cells off the object.
  Eigen::Vector3f outside = Eigen::Vector3f::Zero();
  float outside_cells = 0.0F;
  while (on_stack > 0) {
    const std::size_t cell = stack_[--on_stack];
    bool near = false;
    for_neighbours(cell, [&](std::size_t next) {
      for_neighbours(next, [&](std::size_t second) { near = near || object[second]; });
      visit(next);
    });
    if (!near || !cells.in_frame[cell]) continue;
    outside += cells.colour[cell];
    outside_cells += 1.0F;
  }
  if (outside_cells > 0.0F) outside /= outside_cells;
  for (std::size_t seed = 0; seed < ColourCells::count; ++seed) {
    if (visited_[seed] || object[seed]) continue;
    std::size_t found = 0;
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    on_stack = 0;
    visit(seed);
    // The list grows while it is read; in the end it holds the hole.
    while (found < on_stack) {
      const std::size_t cell = stack_[found++];
      sum += cells.colour[cell];
      for_neighbours(cell, visit);
    }
    const Eigen::Vector3f hole = sum / static_cast<float>(found);
    if (filled != Holes::all && outside_cells > 0.0F &&
        (hole - outside).norm() < hole_contrast_min) {
      continue;
    }
    for (std::size_t i = 0; i < found; ++i) object[stack_[i]] = true;
  }
}

}  // namespace gazed::tracking
