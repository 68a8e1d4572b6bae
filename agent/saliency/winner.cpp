#include "agent/saliency/winner.hpp"

#include <algorithm>
#include <cstdint>

#include "agent/saliency/pyramid.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

namespace {

// Vertex of the parabola through (-1, before), (0, top), (1, after), where top is at least as high
// as both.
double parabola_top(std::int32_t before, std::int32_t top, std::int32_t after) {
  const std::int64_t curvature = std::int64_t{2} * top - before - after;
  if (curvature == 0) return 0.0;
  return static_cast<double>(std::int64_t{after} - before) / static_cast<double>(2 * curvature);
}

}  // namespace

Winner find_winner(const SaliencyPlane& map) {
  int x = 0, y = 0;
  for (int row = 0; row < map.height; ++row) {
    const std::int32_t* top = std::max_element(map.row(row), map.row(row) + map.width);
    if (*top <= map.row(y)[x]) continue;
    x = static_cast<int>(top - map.row(row));
    y = row;
  }
  return refined_winner(map, x, y);
}

Winner refined_winner(const SaliencyPlane& map, int x, int y) {
  const std::int32_t* top = map.row(y) + x;
  double dx = 0.0, dy = 0.0;
  if (x > 0 && x < map.width - 1) dx = parabola_top(top[-1], top[0], top[1]);
  if (y > 0 && y < map.height - 1) dy = parabola_top(top[-map.stride], top[0], top[map.stride]);
  static_assert(saliency_cell_px == 1 << map_level);
  return {x, y, saliency_cell_px * geometry::Pixel(x + dx, y + dy)};
}

// Every step is strictly upwards, so the loop ends.
Winner summit_above(const SaliencyPlane& map, int x, int y) {
  while (true) {
    int best_x = x, best_y = y;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, map.height - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, map.width - 1); ++u) {
        if (map.row(v)[u] <= map.row(best_y)[best_x]) continue;
        best_x = u;
        best_y = v;
      }
    }
    if (best_x == x && best_y == y) return refined_winner(map, x, y);
    x = best_x;
    y = best_y;
  }
}

}  // namespace gazed::saliency
