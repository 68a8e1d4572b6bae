#include "agent/saliency/flicker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/normalization.hpp"
#include "agent/saliency/pyramid.hpp"

namespace gazed::saliency {

namespace {

static_assert(flicker_level == map_level - 1);

// Where S and F are mixed they are in Q8 (16 bits), so that a product with the share fits in 32
// bits.
constexpr int flicker_share_bits = 14;
constexpr int mixed_fraction_bits = 8;
static_assert((std::int64_t{map_maximum} << (mixed_fraction_bits + flicker_share_bits)) <=
              std::numeric_limits<std::int32_t>::max());

// Filter [1 2 1] in both directions: three taps are enough, since the planes are already smooth.
constexpr int filter_gain_log2 = 2;
constexpr std::int32_t largest_intensity = 255 * samples_per_grey_level;
static_assert((largest_intensity << filter_gain_log2) <= std::numeric_limits<std::uint16_t>::max());

struct RowPair {
  const std::int16_t* now;
  const std::int16_t* before;
};

// Absolute difference, within 16 bits so that eight are computed at a time.
std::uint16_t change(const RowPair& rows, int x) {
  return static_cast<std::uint16_t>(std::max(rows.now[x], rows.before[x]) -
                                    std::min(rows.now[x], rows.before[x]));
}

void weigh_rows(const RowPair& above, const RowPair& centre, const RowPair& below, int width,
                std::uint16_t* out) {
  for (int x = 0; x < width; ++x)
    out[x] =
        static_cast<std::uint16_t>(change(above, x) + 2 * change(centre, x) + change(below, x));
}

// A frame of 2560x1920 has 19200 samples.
static_assert(std::int64_t{largest_intensity} * 19200 <= std::numeric_limits<std::int32_t>::max());

std::uint32_t weight_of(const ConstPlane& map, std::int32_t noise_floor) {
  std::int32_t maximum = 0, sum = 0;
  for (int y = 0; y < map.height; ++y) {
    for (const std::int16_t sample : std::span(map.row(y), static_cast<std::size_t>(map.width))) {
      maximum = std::max<std::int32_t>(maximum, sample);
      sum += sample;
    }
  }
  MapPeaks peaks;
  peaks.maximum = maximum;
  peaks.sum_of_others = sum;
  peaks.others = std::int64_t{map.width} * map.height;
  return promotion_weight(peaks, noise_floor);
}

}  // namespace

Flicker::Flicker(double share, std::int32_t noise_floor, int frame_width, int frame_height)
    : share_(static_cast<std::int32_t>(std::lround((1 << flicker_share_bits) * share))),
      noise_floor_(noise_floor),
      before_(length_at_level(frame_width, flicker_level),
              length_at_level(frame_height, flicker_level)),
      column_(static_cast<std::size_t>(before_.view().width) + 2),
      change_(length_at_level(frame_width, map_level), length_at_level(frame_height, map_level)) {}

ConstPlane Flicker::reduced_change(const ConstPlane& intensity) {
  const ConstPlane before = before_.view();
  const auto rows = [&](int y) {
    const int inside = reflect_101(y, before.height);
    return RowPair{intensity.row(inside), before.row(inside)};
  };
  const Plane change = change_.view();
  for (int y = 0; y < change.height; ++y) {
    std::uint16_t* centre = column_.data() + 1;
    weigh_rows(rows(2 * y - 1), rows(2 * y), rows(2 * y + 1), before.width, centre);
    centre[-1] = centre[reflect_101(-1, before.width)];
    centre[before.width] = centre[reflect_101(before.width, before.width)];
    std::int16_t* out = change.row(y);
    for (int x = 0; x < change.width; ++x, centre += 2)
      out[x] = static_cast<std::int16_t>(
          rounding_shift<2 * filter_gain_log2>(centre[-1] + 2 * centre[0] + centre[1]));
  }
  return change;
}

void Flicker::add_to(const PlaneView<std::int32_t>& saliency, const ConstPlane& intensity,
                     bool still) {
  if (primed_ && still) {
    const ConstPlane map = reduced_change(intensity);
    const std::uint32_t weight = weight_of(map, noise_floor_);
    constexpr int promoted_shift = weight_fraction_bits - mixed_fraction_bits;
    constexpr int saliency_shift = conspicuity_fraction_bits - mixed_fraction_bits;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        // At most the maximum times the weight: 255 in Q24.
        const auto promoted = static_cast<std::int32_t>(
            (static_cast<std::uint32_t>(map.row(y)[x]) * weight) >> promoted_shift);
        std::int32_t& s = saliency.row(y)[x];
        const std::int32_t step = promoted - (s >> saliency_shift);
        s += (step * share_) >> (flicker_share_bits - saliency_shift);
      }
    }
  }
  std::copy(intensity.data, intensity.row(intensity.height), before_.view().data);
  primed_ = true;
}

}  // namespace gazed::saliency
