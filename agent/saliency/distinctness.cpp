#include "agent/saliency/distinctness.hpp"

#include <algorithm>
#include <cstdlib>

#include "agent/saliency/fixed.hpp"

namespace gazed {

namespace {

// Measured on the map's level of the pictures named at SaliencySettings::distinctness_min: the
// enclosure of turf is below 5 grey levels, of nine objects in ten above 34; shading of 15 to 70 %
// across a wall steps by at most 9 grey levels, discs from 16 pixels across by at least 25.
constexpr double half_enclosure = 16.0;
constexpr double half_sharpness = 12.0;
constexpr int neighbourhood_divisor = 5;  // of the map's width

// Samples to a grey level, for intensity and the two opponents.
constexpr std::array<double, 3> plane_samples_per_grey_level{
    samples_per_grey_level, samples_per_colour_level, samples_per_colour_level};

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

std::int32_t largest_step(const ConstPlane& plane) {
  std::int32_t largest = 0;
  for (int y = 0; y < plane.height; ++y) {
    const std::int16_t* row = plane.row(y);
    for (int x = 0; x + 1 < plane.width; ++x)
      largest = std::max(largest, std::abs(row[x + 1] - row[x]));
    if (y + 1 == plane.height) break;
    const std::int16_t* below = plane.row(y + 1);
    for (int x = 0; x < plane.width; ++x) largest = std::max(largest, std::abs(below[x] - row[x]));
  }
  return largest;
}

}  // namespace

Distinctness::Distinctness(int map_width, int map_height) : enclosure_(map_width, map_height) {}

double Distinctness::of(const SaliencyPlane& map, const Winner& winner,
                        const PlanesAtMapLevel& planes) {
  if (map.row(winner.y)[winner.x] == 0) return 0.0;
  double height = 0.0, step = 0.0;  // grey levels
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double scale = plane_samples_per_grey_level[k];
    height = std::max(height, enclosure_.height_at(planes[k], winner.x, winner.y) / scale);
    step = std::max(step, largest_step(planes[k]) / scale);
  }
  const double enclosure = height / (height + half_enclosure);
  const double sharpness = step * step / (step * step + half_sharpness * half_sharpness);
  return sharpness * (concentration(map, winner) + enclosure) / 2.0;
}

}  // namespace gazed
