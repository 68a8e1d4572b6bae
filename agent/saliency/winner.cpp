#include "agent/saliency/winner.hpp"

#include <algorithm>

#include "agent/saliency/pyramid.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed {

namespace {

// Top of the parabola through (-1, before), (0, top), (1, after), where top is not below either.
double parabola_top(std::int32_t before, std::int32_t top, std::int32_t after) {
  const std::int64_t curvature = std::int64_t{2} * top - before - after;
  if (curvature == 0) return 0.0;
  return static_cast<double>(std::int64_t{after} - before) / static_cast<double>(2 * curvature);
}

}  // namespace

Winner find_winner(const SaliencyPlane& map) {
  Winner winner;
  const std::int32_t* top = map.data;
  for (int y = 0; y < map.height; ++y) {
    const std::int32_t* of_row = std::max_element(map.row(y), map.row(y) + map.width);
    if (*of_row <= *top) continue;
    top = of_row;
    winner.x = static_cast<int>(of_row - map.row(y));
    winner.y = y;
  }
  double dx = 0.0, dy = 0.0;
  if (winner.x > 0 && winner.x < map.width - 1) dx = parabola_top(top[-1], top[0], top[1]);
  if (winner.y > 0 && winner.y < map.height - 1)
    dy = parabola_top(top[-map.stride], top[0], top[map.stride]);
  static_assert(saliency_cell_px == 1 << map_level);
  winner.pixel = saliency_cell_px * Pixel(winner.x + dx, winner.y + dy);
  return winner;
}

}  // namespace gazed
