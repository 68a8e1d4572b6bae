#include "agent/saliency/surroundedness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency {

namespace {

using Word = BitPlane::Word;

constexpr int level_bits = 26;  // a range's levels, and a half, fit in 32 bits
static_assert((std::int64_t{Surroundedness::most_thresholds} << level_bits) +
                  (1 << (level_bits - 1)) <=
              std::numeric_limits<std::int32_t>::max());

// A dilated area has 9 samples at least, so a boolean map adds a third at most.
constexpr std::int32_t one_in_sum = 1023;
constexpr int most_boolean_maps = Surroundedness::most_planes * 2 * Surroundedness::most_thresholds;
static_assert(most_boolean_maps * one_in_sum / 3 <= std::numeric_limits<std::int16_t>::max());

constexpr double unit_side = 80.0;  // of level 3 of 640 pixels, for the units of Attention

static_assert(lane_count == 8);  // a byte of bits

// All ones for every bit that is set.
constexpr auto lanes_of_byte = [] {
  std::array<std::array<std::int16_t, lane_count>, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte)
    for (std::size_t bit = 0; bit < lane_count; ++bit)
      table[byte][bit] = (byte >> bit & 1) != 0 ? std::int16_t{-1} : std::int16_t{0};
  return table;
}();

// value / sqrt(area), rounded. IEEE 754 fixes both operations: the same everywhere.
std::int16_t over_root(double value, int area) {
  return static_cast<std::int16_t>(std::lround(value / std::sqrt(static_cast<double>(area))));
}

std::pair<std::int32_t, std::int32_t> extremes(const ConstPlane& plane) {
  std::int16_t lowest = plane.row(0)[0], highest = lowest;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      lowest = std::min(lowest, plane.row(y)[x]);
      highest = std::max(highest, plane.row(y)[x]);
    }
  }
  return {lowest, highest};
}

}  // namespace

Surroundedness::Surroundedness(int frame_width, int frame_height)
    : width_(length_at_level(frame_width, surroundedness_level)),
      height_(length_at_level(frame_height, surroundedness_level)),
      slices_{BitPlane(width_, height_), BitPlane(width_, height_), BitPlane(width_, height_),
              BitPlane(width_, height_)},
      map_(width_, height_),
      reached_(width_, height_),
      dilated_(width_, height_),
      sum_(width_, height_),
      reduction_(frame_width, frame_height),
      row_blurred_(halved(width_), halved(height_)),
      saliency_(halved(width_), halved(height_)) {}

void Surroundedness::begin() {
  fill(sum_.view(), std::int16_t{0});
}

void Surroundedness::add(const ConstPlane& plane, std::int32_t noise_floor, double weight) {
  const auto [lowest, highest] = extremes(plane);
  const std::int32_t range = highest - lowest;
  const int thresholds = std::min(most_thresholds, range / std::max(noise_floor, 1));
  if (thresholds == 0 || weight <= 0.0) return;
  slice(plane, lowest, (thresholds << level_bits) / range);
  for (int i = 1; i <= thresholds; ++i) {
    cut(i);
    add_surrounded(weight);
    for (int y = 0; y < height_; ++y)
      for (int k = 0; k < map_.row_words(); ++k) map_.row(y)[k] ^= map_.inside(k);
    add_surrounded(weight);
  }
}

// The number of thresholds below each sample, 0 to 15, as four planes of bits. Threshold i of n
// lies (i - 1/2) / n of the range above the lowest sample.
void Surroundedness::slice(const ConstPlane& plane, std::int32_t lowest,
                           std::int32_t levels_per_sample) {
  for (int y = 0; y < height_; ++y) {
    const std::int16_t* samples = plane.row(y);
    for (int k = 0; k < map_.row_words(); ++k) {
      const int start = k * BitPlane::word_bits;
      const int count = std::min(BitPlane::word_bits, width_ - start);
      std::array<Word, slice_count> words{};
      for (int x = 0; x < count; ++x) {
        const auto level = static_cast<Word>(
            rounding_shift<level_bits>((samples[start + x] - lowest) * levels_per_sample));
        for (std::size_t bit = 0; bit < slice_count; ++bit) words[bit] |= (level >> bit & 1) << x;
      }
      for (std::size_t bit = 0; bit < slice_count; ++bit) slices_[bit].row(y)[k] = words[bit];
    }
  }
}

// The map of the samples above a threshold: compares all numbers of a word's width at once, from
// the lowest bit up.
void Surroundedness::cut(int threshold) {
  for (int y = 0; y < height_; ++y) {
    for (int k = 0; k < map_.row_words(); ++k) {
      Word at_least = map_.inside(k);
      for (std::size_t bit = 0; bit < slice_count; ++bit) {
        const Word slice = slices_[bit].row(y)[k];
        at_least = (threshold >> bit & 1) != 0 ? (at_least & slice) : (at_least | slice);
      }
      map_.row(y)[k] = at_least;
    }
  }
}

void Surroundedness::add_surrounded(double weight) {
  flood_from_border(map_, reached_);
  Word any = 0;
  for (std::size_t i = 0; i < map_.words().size(); ++i)
    any |= reached_.words()[i] = map_.words()[i] & ~reached_.words()[i];
  if (any == 0) return;
  dilate(reached_, dilated_);
  accumulate(dilated_, over_root(one_in_sum * weight, dilated_.count()));
}

void Surroundedness::accumulate(const BitPlane& area, std::int16_t value) {
  const Plane plane = sum_.view();
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; x += lane_count) {
      const Word word = area.row(y)[x / BitPlane::word_bits];
      const auto byte = static_cast<std::uint8_t>(word >> (x % BitPlane::word_bits));
      if (byte == 0) continue;
      const std::array<std::int16_t, lane_count>& lanes = lanes_of_byte[byte];
      std::int16_t* sum = plane.row(y) + x;
      for (std::size_t i = 0; i < lane_count; ++i)
        sum[i] = static_cast<std::int16_t>(sum[i] + (value & lanes[i]));
    }
  }
}

// One pass of the pyramid's filter over the reduced map, borders reflected, into saliency_.
void Surroundedness::blur_map() {
  const ConstPlane map = reduction_.map();
  const PlaneView<std::int32_t> along_rows = row_blurred_.view(), blurred = saliency_.view();
  const auto filtered_at = [](const auto& sample, int i, int length) {
    const auto at = [&](int k) { return std::int32_t{sample(reflect_101(k, length))}; };
    return at(i - 2) + at(i + 2) + 4 * (at(i - 1) + at(i + 1)) + 6 * at(i);
  };
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      along_rows.row(y)[x] = filtered_at([&](int u) { return map.row(y)[u]; }, x, map.width);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      blurred.row(y)[x] = filtered_at([&](int v) { return along_rows.row(v)[x]; }, y, map.height);
}

PlaneView<std::int32_t> Surroundedness::saliency() {
  for (int y = 0; y < height_; ++y) reduction_.push(surroundedness_level, sum_.view().row(y));
  blur_map();
  const PlaneView<std::int32_t> saliency = saliency_.view();
  std::int64_t largest = 0, sum = 0;
  for (int y = 0; y < saliency.height; ++y) {
    for (int x = 0; x < saliency.width; ++x) {
      largest = std::max<std::int64_t>(largest, saliency.row(y)[x]);
      sum += saliency.row(y)[x];
    }
  }
  // In a frame of twice the longer side the same things have four times the samples.
  const double one =
      one_in_sum * binomial_gain * binomial_gain * unit_side / std::max(width_, height_);
  attention_ = {static_cast<double>(largest) / one,
                static_cast<double>(sum) / one / (saliency.width * saliency.height)};
  if (largest == 0) return saliency;
  // s (s + 1) / 2 of each share s of the largest: NSS on OSIE 0.02 more than of the share itself.
  constexpr std::int64_t half_scale = (std::int64_t{map_maximum} << conspicuity_fraction_bits) / 2;
  for (int y = 0; y < saliency.height; ++y) {
    for (int x = 0; x < saliency.width; ++x) {
      const std::int64_t sample = saliency.row(y)[x];
      saliency.row(y)[x] =
          static_cast<std::int32_t>(half_scale * sample / largest * (sample + largest) / largest);
    }
  }
  return saliency;
}

}  // namespace gazed::saliency
