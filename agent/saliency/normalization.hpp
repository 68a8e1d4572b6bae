// N, the operator that promotes maps with one strong peak (Itti, Koch, Niebur 1998, section 2.2;
// the report's Lambda). The report's mean includes the global maximum, and would multiply a map
// with a single peak by 0: corrected here, as in 1998.
//
// N scales a map to the maximum M = 255 and multiplies it by (M - m)^2 / M^2, m the mean of its
// local maxima other than the global one. Both are one factor: the weight.
#pragma once

#include <cstdint>

#include "agent/saliency/plane.hpp"

namespace gazed::saliency {

struct MapPeaks {
  std::int32_t maximum = 0;
  int maximum_x = 0;  // the first one in raster order
  int maximum_y = 0;
  std::int64_t sum_of_others = 0;  // local maxima except that one
  std::int64_t others = 0;
};

/// A local maximum is a sample inside the border, above a tenth of the maximum, not below any of
/// its 4 neighbours and above at least one. The sample at (maximum_x, maximum_y) is left out; other
/// samples as large are not. Samples are not negative; what pads a row does not count.
[[nodiscard]] MapPeaks find_peaks(const ConstPlane& map);

/// 255 (1 - m/M)^2 / M in Q24; 0 when the maximum is 0 or below `noise_floor`. At most 255 x 2^24.
[[nodiscard]] std::uint32_t promotion_weight(const MapPeaks& peaks, std::int32_t noise_floor);

inline constexpr int weight_fraction_bits = 24;

/// Adds `weight` times `map` to `sum`, both of the same size, in Q16. The weight counts in 15
/// significant bits, as many as a sample of the map has; the product is cut off, not rounded. The
/// weighted map is below 2^15 in Q16, its samples are not negative.
void add_weighted(const ConstPlane& map, std::uint64_t weight, int weight_fraction,
                  const PlaneView<std::int32_t>& sum);

}  // namespace gazed::saliency
