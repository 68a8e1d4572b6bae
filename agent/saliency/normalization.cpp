#include "agent/saliency/normalization.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency {

using namespace lanes;

namespace {

/// -1 in those of eight lanes from `x` on that are inside [first, end).
I16x8 lanes_within(int first, int end, int x) {
  const auto lane = [](int i) {
    return splat(static_cast<std::int16_t>(std::clamp(i, -1, lane_count)));
  };
  const I16x8 index = multiples(1);
  return is_greater(index, lane(first - 1 - x)) & is_greater(lane(end - x), index);
}

/// What is outside the row is 0.
I16x8 load_row_end(const ConstPlane& map, int x, int y) {
  return load(map.row(y) + x) & lanes_within(0, map.width, x);
}

void find_maximum(const ConstPlane& map, MapPeaks& peaks) {
  const int last_block = map.stride - lane_count;
  int first_row = 0;
  peaks.maximum = -1;
  for (int y = 0; y < map.height; ++y) {
    I16x8 largest = load_row_end(map, last_block, y);
    for (int x = 0; x < last_block; x += lane_count)
      largest = larger(largest, load(map.row(y) + x));
    if (const int of_row = largest_lane(largest); of_row > peaks.maximum) {
      peaks.maximum = of_row;
      first_row = y;
    }
  }
  peaks.maximum_y = first_row;
  peaks.maximum_x = static_cast<int>(
      std::find(map.row(first_row), map.row(first_row) + map.width, peaks.maximum) -
      map.row(first_row));
}

/// Local maxima of the rows that were added.
class LocalMaxima {
 public:
  /// Of a map, above `least`.
  LocalMaxima(const ConstPlane& map, std::int16_t least)
      : map_(map),
        least_(splat(least)),
        inside_first_(lanes_within(1, map.width - 1, 0)),
        inside_last_(lanes_within(1, map.width - 1, map.stride - lane_count)) {}

  /// A row inside the border.
  void add_row(int y) {
    const int last_block = map_.stride - lane_count;
    add(y, 0, inside_first_);
    for (int x = lane_count; x < last_block; x += lane_count) add(y, x, splat(-1));
    if (last_block > 0) add(y, last_block, inside_last_);
  }

  [[nodiscard]] std::int64_t count() const { return total(count_); }
  [[nodiscard]] std::int64_t sum() const { return total(sum_); }

 private:
  void add(int y, int x, I16x8 inside) {
    const std::int16_t* at = map_.row(y) + x;
    const I16x8 v = load(at), up = load(at - map_.stride), down = load(at + map_.stride);
    const I16x8 left = load_unaligned(at - 1), right = load_unaligned(at + 1);
    const I16x8 highest = larger(larger(up, down), larger(left, right));
    const I16x8 candidates = without(is_greater(v, least_), is_greater(highest, v));
    if (!any(candidates)) return;  // more often than not
    const I16x8 lowest = smaller(smaller(up, down), smaller(left, right));
    const I16x8 maxima = candidates & is_greater(v, lowest) & inside;
    count_ = count_ + pair_sums(maxima, splat(-1));
    sum_ = sum_ + pair_sums(v & maxima, splat(1));
  }

  /// A lane adds at most 640 x 480 / 4 samples of less than 2^15, that is less than 2^32.
  static std::int64_t total(I32x4 sums) {
    alignas(16) std::array<std::int32_t, 4> each_sum{};
    store(each_sum.data(), sums);
    std::int64_t all = 0;
    for (const std::int32_t sum : each_sum) all += static_cast<std::uint32_t>(sum);
    return all;
  }

  ConstPlane map_;
  I16x8 least_, inside_first_, inside_last_;
  I32x4 count_{}, sum_{};
};

/// Whether the global maximum is in the list: inside the border, and above a neighbour.
bool is_listed(const ConstPlane& map, const MapPeaks& peaks) {
  const int x = peaks.maximum_x, y = peaks.maximum_y;
  if (x < 1 || y < 1 || x > map.width - 2 || y > map.height - 2) return false;
  const std::int16_t* at = map.row(y) + x;
  return peaks.maximum > 0 &&
         std::min({at[-1], at[1], map.row(y - 1)[x], map.row(y + 1)[x]}) < peaks.maximum;
}

}  // namespace

MapPeaks find_peaks(const ConstPlane& map) {
  MapPeaks peaks;
  find_maximum(map, peaks);
  LocalMaxima maxima(map, static_cast<std::int16_t>(peaks.maximum / 10));
  for (int y = 1; y < map.height - 1; ++y) maxima.add_row(y);
  peaks.sum_of_others = maxima.sum();
  peaks.others = maxima.count();
  if (is_listed(map, peaks)) {
    peaks.sum_of_others -= peaks.maximum;
    --peaks.others;
  }
  return peaks;
}

std::uint32_t promotion_weight(const MapPeaks& peaks, std::int32_t noise_floor) {
  if (peaks.maximum <= 0 || peaks.maximum < noise_floor) return 0;
  constexpr int ratio_bits = 30;  // of 1 - m/M; products stay below 2^64
  std::uint64_t rest = std::uint64_t{1} << ratio_bits;
  if (peaks.others > 0) {
    // others x maximum: at most 2^19 samples (640x480) of less than 2^15
    const auto all =
        static_cast<std::uint64_t>(peaks.others) * static_cast<std::uint64_t>(peaks.maximum);
    rest = ((all - static_cast<std::uint64_t>(peaks.sum_of_others)) << ratio_bits) / all;
  }
  const std::uint64_t squared = (rest * rest) >> ratio_bits;
  const std::uint64_t scale = (std::uint64_t{map_maximum} << weight_fraction_bits) * squared;
  return static_cast<std::uint32_t>((scale / static_cast<std::uint64_t>(peaks.maximum)) >>
                                    ratio_bits);
}

void add_weighted(const ConstPlane& map, std::uint64_t weight, int weight_fraction,
                  const PlaneView<std::int32_t>& sum) {
  if (weight == 0) return;
  constexpr int significant_bits = 15;
  const int cut = std::max(static_cast<int>(std::bit_width(weight)) - significant_bits, 0);
  const auto factor = splat(static_cast<std::int16_t>(weight >> cut));
  // map x factor < 2^30 is in Q(weight_fraction - cut).
  const int down = weight_fraction - cut - conspicuity_fraction_bits;
  const auto in_q16 = [&](I32x4 product) {
    return down >= 0 ? shifted_right_by(product, std::min(down, 31))
                     : shifted_left_by(product, -down);
  };
  for (int y = 0; y < map.height; ++y) {
    const std::int16_t* row = map.row(y);
    std::int32_t* to = sum.row(y);
    for (int x = 0; x < map.width; x += lane_count) {
      const I16x8 samples = load(row + x);
      store(to + x, load(to + x) + in_q16(pair_sums(interleaved_low(samples, I16x8{}), factor)));
      store(to + x + 4,
            load(to + x + 4) + in_q16(pair_sums(interleaved_high(samples, I16x8{}), factor)));
    }
  }
}

}  // namespace gazed::saliency
