// From the order in which a camera sends its samples to phases (phases.hpp), a block of 32 columns
// at a time.
//
// Three or more vectors are sorted by perfect shuffles: the first half of the sequence interleaved
// with the second moves sample n of N to 2n modulo N - 1. For N = 3 x 16 bytes, sample n = 3x + c,
// channel c of column x, two shuffles move it to 12x + 4c modulo 47, which for x = 4m + p is
// m + 4c + 12p: groups of the same phase and channel. Likewise one shuffle for 3 x 8 samples.
#pragma once

#include <array>
#include <cstdint>

#include "agent/saliency/lanes.hpp"

namespace gazed::saliency {

/// Eight samples of one plane in each of its phases.
using FourPhases = std::array<lanes::I16x8, 4>;
using TwoPhases = std::array<lanes::I16x8, 2>;

template <typename V>
using Three = std::array<V, 3>;

/// One shuffle of three times sixteen bytes.
[[nodiscard]] inline Three<lanes::U8x16> shuffled(const Three<lanes::U8x16>& v) {
  return {interleaved_low(v[0], high_half(v[1])), interleaved_low(high_half(v[0]), v[2]),
          interleaved_low(v[1], high_half(v[2]))};
}

/// The first shuffle, from memory: half vectors need no half moved.
[[nodiscard]] inline Three<lanes::U8x16> shuffled(const std::uint8_t* bytes) {
  const auto half = [bytes](int i) { return lanes::load_half(bytes + 8 * i); };
  return {interleaved_low(half(0), half(3)), interleaved_low(half(1), half(4)),
          interleaved_low(half(2), half(5))};
}
[[nodiscard]] inline Three<lanes::I16x8> shuffled(const std::int16_t* samples) {
  const auto half = [samples](int i) { return lanes::load_half(samples + 4 * i); };
  return {interleaved_low(half(0), half(3)), interleaved_low(half(1), half(4)),
          interleaved_low(half(2), half(5))};
}

/// r, g, b of 32 columns: 96 bytes.
[[nodiscard]] inline Three<FourPhases> unzip_rgb(const std::uint8_t* block) {
  const auto left = shuffled(shuffled(block)), right = shuffled(shuffled(block + 48));
  // Groups of four from the left and from the right half of the block come side by side.
  Three<lanes::U8x16> low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = interleaved_quads_low(left[i], right[i]);
    high[i] = interleaved_quads_high(left[i], right[i]);
  }
  return {FourPhases{widened_low(low[0]), widened_high(high[0]), widened_low(high[1]),
                     widened_high(low[2])},
          FourPhases{widened_high(low[0]), widened_low(low[1]), widened_high(high[1]),
                     widened_low(high[2])},
          FourPhases{widened_low(high[0]), widened_high(low[1]), widened_low(low[2]),
                     widened_high(high[2])}};
}

/// The same of 96 samples of 16 bits.
[[nodiscard]] inline Three<FourPhases> unzip_rgb(const std::int16_t* block) {
  const std::array parts{shuffled(block), shuffled(block + 24), shuffled(block + 48),
                         shuffled(block + 72)};
  Three<FourPhases> out;
  for (std::size_t i = 0; i < 3; ++i) {
    // Pairs of the same phase and channel: pair k of vector i has phase and channel 4i + k = 3p +
    // c.
    const auto low_left = interleaved_pairs_low(parts[0][i], parts[1][i]);
    const auto low_right = interleaved_pairs_low(parts[2][i], parts[3][i]);
    const auto high_left = interleaved_pairs_high(parts[0][i], parts[1][i]);
    const auto high_right = interleaved_pairs_high(parts[2][i], parts[3][i]);
    const auto place = [&](std::size_t k) -> lanes::I16x8& {
      const std::size_t index = 4 * i + k;
      return out[index % 3][index / 3];
    };
    place(0) = low_halves(low_left, low_right);
    place(1) = high_halves(low_left, low_right);
    place(2) = low_halves(high_left, high_right);
    place(3) = high_halves(high_left, high_right);
  }
  return out;
}

struct YuvPhases {
  FourPhases y;
  TwoPhases u, v;  // a row of u or v has half the columns
};

/// y0 u0 y1 v0 y2 u1 ... of 32 columns: 64 samples, as an 8 x 8 matrix transposed.
[[nodiscard]] inline YuvPhases unzip_yuyv(const std::int16_t* block) {
  using Eight = std::array<lanes::I16x8, 8>;
  Eight rows, pairs, quads, out;
  for (std::size_t i = 0; i < 8; ++i) rows[i] = lanes::load(block + 8 * i);
  for (std::size_t i = 0; i < 8; i += 2) {
    pairs[i] = interleaved_low(rows[i], rows[i + 1]);
    pairs[i + 1] = interleaved_high(rows[i], rows[i + 1]);
  }
  for (std::size_t i = 0; i < 8; i += 4) {
    for (std::size_t k = 0; k < 2; ++k) {
      quads[i + 2 * k] = interleaved_pairs_low(pairs[i + k], pairs[i + k + 2]);
      quads[i + 2 * k + 1] = interleaved_pairs_high(pairs[i + k], pairs[i + k + 2]);
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    out[2 * i] = low_halves(quads[i], quads[i + 4]);
    out[2 * i + 1] = high_halves(quads[i], quads[i + 4]);
  }
  return {{out[0], out[2], out[4], out[6]}, {out[1], out[5]}, {out[3], out[7]}};
}

}  // namespace gazed::saliency
