#include "agent/saliency/normalization.hpp"

#include <algorithm>

#include "agent/saliency/fixed.hpp"

namespace gazed {

MapPeaks find_peaks(const ConstPlane& map) {
  MapPeaks peaks;
  const std::int16_t* first = std::max_element(map.data, map.data + map.size());
  const int index = static_cast<int>(first - map.data);
  peaks.maximum = *first;
  peaks.maximum_x = index % map.width;
  peaks.maximum_y = index / map.width;
  for (int y = 1; y < map.height - 1; ++y) {
    const std::int16_t *above = map.row(y - 1), *row = map.row(y), *below = map.row(y + 1);
    for (int x = 1; x < map.width - 1; ++x) {
      const std::int16_t v = row[x];
      const std::int16_t highest = std::max({above[x], below[x], row[x - 1], row[x + 1]});
      const std::int16_t lowest = std::min({above[x], below[x], row[x - 1], row[x + 1]});
      if (v < highest || v == lowest || 10 * v <= peaks.maximum) continue;
      if (row + x == first) continue;
      peaks.sum_of_others += v;
      ++peaks.others;
    }
  }
  return peaks;
}

std::uint32_t promotion_weight(const MapPeaks& peaks, std::int32_t noise_floor) {
  if (peaks.maximum <= 0 || peaks.maximum < noise_floor) return 0;
  constexpr int ratio_bits = 30;  // of 1 - m/M; products stay below 2^62
  std::uint64_t rest = std::uint64_t{1} << ratio_bits;
  if (peaks.others > 0) {
    // others x maximum: fewer than 2^17 local maxima (640x480 samples, at most every second) of
    // less than 2^15
    const auto all =
        static_cast<std::uint64_t>(peaks.others) * static_cast<std::uint64_t>(peaks.maximum);
    rest = ((all - static_cast<std::uint64_t>(peaks.sum_of_others)) << ratio_bits) / all;
  }
  const std::uint64_t squared = (rest * rest) >> ratio_bits;
  const std::uint64_t scale = (std::uint64_t{map_maximum} << weight_fraction_bits) * squared;
  return static_cast<std::uint32_t>((scale / static_cast<std::uint64_t>(peaks.maximum)) >>
                                    ratio_bits);
}

}  // namespace gazed
