#include "agent/saliency/distinctness.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

// Measured at the map's level on the pictures listed at SaliencySettings::distinctness_min: the
// enclosure of turf is below 5 grey levels, that of nine objects in ten above 34. Shading of 15 to
// 70 % across a wall has steps of at most 9 grey levels, discs of 16 pixels and more have steps of
// at least 25.
constexpr double half_enclosure = 16.0;
constexpr double half_sharpness = 12.0;
constexpr int neighbourhood_divisor = 5;  // of the map's width

double concentration(const SaliencyPlane& map, const Winner& winner) {
  const int radius = map.width / neighbourhood_divisor;
  constexpr int shift = 8;  // S in Q8: squares below 2^32, their sum below 2^47
  std::uint64_t near = 0, all = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto s = static_cast<std::uint64_t>(map.row(y)[x]) >> shift;
      const int dx = x - winner.x, dy = y - winner.y;
      all += s * s;
      if (dx * dx + dy * dy <= radius * radius) near += s * s;
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(near) / static_cast<double>(all);
}

/// Largest difference to the neighbours on the right and below; it is below 2^15.
std::int32_t step_at(const ConstPlane& plane, int x, int y) {
  const std::int16_t *row = plane.row(y), *below = plane.row(std::min(y + 1, plane.height - 1));
  const int right = std::min(x + 1, plane.width - 1);
  return std::max(std::abs(row[right] - row[x]), std::abs(below[x] - row[x]));
}

/// The largest over all samples.
std::int32_t largest_step(const ConstPlane& plane) {
  I16x8 largest{};
  std::int32_t at_row_ends = 0;
  const int whole = (plane.width - 1) / lane_count * lane_count;
  for (int y = 0; y < plane.height; ++y) {
    const std::int16_t *row = plane.row(y), *below = plane.row(std::min(y + 1, plane.height - 1));
    for (int x = 0; x < whole; x += lane_count) {
      const I16x8 at = load(row + x);
      largest = larger(largest, magnitude(load_unaligned(row + x + 1) - at));
      largest = larger(largest, magnitude(load(below + x) - at));
    }
    for (int x = whole; x < plane.width; ++x)
      at_row_ends = std::max(at_row_ends, step_at(plane, x, y));
  }
  return std::max<std::int32_t>(largest_lane(largest), at_row_ends);
}

double sharpness(double largest_step_grey_levels) {
  const double square = largest_step_grey_levels * largest_step_grey_levels;
  return square / (square + half_sharpness * half_sharpness);
}

// In grey levels, over all planes.
double largest_step(const PlanesAtMapLevel& planes) {
  double step = 0.0;
  for (std::size_t k = 0; k < planes.size(); ++k)
    step = std::max(step, largest_step(planes[k]) / plane_samples_per_grey_level[k]);
  return step;
}

}  // namespace

Distinctness::Distinctness(int map_width, int map_height) : enclosure_(map_width, map_height) {}

double Distinctness::of(const SaliencyPlane& map, const Winner& winner,
                        const PlanesAtMapLevel& planes) {
  if (map.row(winner.y)[winner.x] == 0) return 0.0;
  double height = 0.0;  // grey levels
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double scale = plane_samples_per_grey_level[k];
    // already reached in earlier planes
    const auto least = static_cast<std::int32_t>(height * scale);
    height = std::max(height, enclosure_.height_at(planes[k], winner.x, winner.y, least) / scale);
  }
  const double enclosure = height / (height + half_enclosure);
  return sharpness(largest_step(planes)) * (concentration(map, winner) + enclosure) / 2.0;
}

double Distinctness::of(const SaliencyPlane& map, const Attention& attention,
                        const PlanesAtMapLevel& planes) {
  const Winner winner = find_winner(map);
  if (attention.peak == 0.0 || map.row(winner.y)[winner.x] == 0) return 0.0;
  return sharpness(largest_step(planes)) *
         object_share(object_or_none_.statistics(map, attention, planes));
}

}  // namespace gazed::saliency
