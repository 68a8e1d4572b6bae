#include "drivers/sim/mipmap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/sim/interpolation.hpp"

namespace gazed::sim {

MipMap::MipMap(int width, int height, int channels, bool wraps, std::vector<std::int16_t> samples)
    : channels_(channels), wraps_(wraps) {
  levels_.push_back({width, height, std::move(samples)});
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(half(levels_.back()));
}

MipMap::Level MipMap::half(const Level& level) const {
  Level smaller{(level.width + 1) / 2, (level.height + 1) / 2, {}};
  smaller.samples.reserve(static_cast<std::size_t>(smaller.width) *
                          static_cast<std::size_t>(smaller.height) *
                          static_cast<std::size_t>(channels_));
  for (int y = 0; y < level.height; y += 2) {
    const std::int16_t* row = level.samples.data() + y * level.width * channels_;
    const std::ptrdiff_t below = y + 1 < level.height ? level.width * channels_ : 0;
    for (int x = 0; x < level.width; x += 2) {
      const std::ptrdiff_t right = x + 1 < level.width ? channels_ : 0;
      for (int c = 0; c < channels_; ++c) {
        const std::int16_t* sample = row + x * channels_ + c;
        const int sum = sample[0] + sample[right] + sample[below] + sample[below + right];
        smaller.samples.push_back(static_cast<std::int16_t>((sum + 2) >> 2));
      }
    }
  }
  return smaller;
}

namespace {

/// The two samples whose centres a place lies between, and how far towards the second.
struct Neighbours {
  int first, second;
  std::int32_t share;
};

template <bool wraps>
Neighbours samples_at(std::int32_t place_q16, int size) {
  // Modulo 2^16, as the places are: a picture that repeats has a side of 2^k.
  const auto from_centre =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(place_q16) - 0x8000U);
  const int floor = from_centre >> 16;
  const std::int32_t share = (from_centre >> (16 - share_bits)) & ((1 << share_bits) - 1);
  if constexpr (wraps) return {floor & (size - 1), (floor + 1) & (size - 1), share};
  return {std::clamp(floor, 0, size - 1), std::clamp(floor + 1, 0, size - 1), share};
}

}  // namespace

template <int channels, bool wraps>
void MipMap::sample_run(Course x, Course y, float footprint, std::span<std::int32_t> values) const {
  const float lod = footprint > 1.0F
                        ? std::min(std::log2(footprint), static_cast<float>(levels_.size() - 1))
                        : 0.0F;
  const int fine = static_cast<int>(lod);
  const auto coarser_share =
      static_cast<std::int32_t>((lod - static_cast<float>(fine)) * (1 << share_bits));
  // Sample i of level n is the mean of samples 2^n i to 2^n (i + 1) - 1 of level 0. A sample has 16
  // bits, what is between two has 2 more.
  const auto look_up = [&](int n, std::int32_t x_q16, std::int32_t y_q16, std::int32_t* out) {
    const Level& level = levels_[static_cast<std::size_t>(n)];
    const Neighbours column = samples_at<wraps>(x_q16 >> n, level.width);
    const Neighbours row = samples_at<wraps>(y_q16 >> n, level.height);
    const std::int16_t* row_1 = level.samples.data() + row.first * level.width * channels;
    const std::int16_t* row_2 = level.samples.data() + row.second * level.width * channels;
    const std::int16_t* in_1 = row_1 + column.first * channels;
    const std::ptrdiff_t to_next = (column.second - column.first) * channels;
    const std::int16_t* in_2 = row_2 + column.first * channels;
    for (int c = 0; c < channels; ++c) {
      const std::int32_t above = between(4 * in_1[c], 4 * in_1[c + to_next], column.share);
      const std::int32_t below = between(4 * in_2[c], 4 * in_2[c + to_next], column.share);
      out[c] = between(above, below, row.share);
    }
  };
  for (std::size_t i = 0; i + channels <= values.size(); i += channels) {
    const std::int32_t x_q16 = x.next(), y_q16 = y.next();
    look_up(fine, x_q16, y_q16, &values[i]);
    if (coarser_share == 0) continue;
    std::int32_t coarser[channels];
    look_up(fine + 1, x_q16, y_q16, coarser);
    for (std::size_t c = 0; c < channels; ++c)
      values[i + c] = between(values[i + c], coarser[c], coarser_share);
  }
}

void MipMap::sample(Course x, Course y, float footprint, std::span<std::int32_t> values) const {
  if (channels_ == 1)
    wraps_ ? sample_run<1, true>(x, y, footprint, values)
           : sample_run<1, false>(x, y, footprint, values);
  else
    wraps_ ? sample_run<3, true>(x, y, footprint, values)
           : sample_run<3, false>(x, y, footprint, values);
}

}  // namespace gazed::sim
