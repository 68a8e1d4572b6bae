// The number formats of the saliency stage.
//
// Qn: an integer that stands for itself divided by 2^n. A plane's `full scale` is the value of pure
// red (red-green), pure blue (blue-yellow) or white (intensity). Level 2 is reached by four passes
// of the filter [1 4 6 4 1], two down the columns and two along the rows. What a format must leave
// room for is the filter's gain of 16 before it is shifted away, so that every pass fits in 16
// bits, eight samples to an SSE register.
//
//   profile  plane                        range          level 0      between      level 2 and up
//   report   S = r + g + b                0 .. 765       Q1   1530    Q1           Q4  12240
//   report   D = (r - g) / S             -1 .. 1         Q11  2047    Q11          Q14 16376
//   report   E = (4b-2r-2g+|r-g|) / S    -2 .. 4         Q9   2047    Q9           Q12 16376
//   robust   r, g, b or Y, U, V           0 .. 255       Q0    255    Q4   4080    Q7  32640
//   robust   S = r + g + b                0 .. 765                                 Q4  12240
//   robust   D = r - g                 -255 .. 255                                 Q6  16320
//   robust   E = 2b - r - g + |r-g|/2  -510 .. 510                                 Q5  16320
//
// Each pass rounds to the format of what it filters; only the first over bytes, whose gain becomes
// the fraction, is exact, and the last keeps three bits of its gain.
//
// From level 2 on every |value| < 2^14, so the sum and the difference of two fit in 16 bits and a
// centre-surround map is at most 2^15 - 1. Both profiles meet there in the same units: full scale
// of an opponent plane is close to 2^14, a grey level of intensity is 48.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace gazed::saliency {

/// (value + 1/2) / 2^shift, rounded down. Two's complement: the same for both signs.
template <int shift>
[[nodiscard]] constexpr std::int32_t rounding_shift(std::int32_t value) {
  static_assert(shift >= 0 && shift < 31);
  if constexpr (shift == 0) {
    return value;
  } else {
    return (value + (1 << (shift - 1))) >> shift;
  }
}

/// Gain of [1 4 6 4 1] in one direction: 1 + 4 + 6 + 4 + 1.
inline constexpr int binomial_gain = 16;
inline constexpr int binomial_gain_log2 = 4;

/// Largest |value| that one pass of the filter takes in 16 bits, with the half that rounds it.
inline constexpr std::int32_t largest_before_filter_signed = 2047;
inline constexpr std::int32_t largest_before_filter_unsigned = 4080;
static_assert(binomial_gain * largest_before_filter_signed + binomial_gain / 2 <=
              std::numeric_limits<std::int16_t>::max());
static_assert(binomial_gain * largest_before_filter_unsigned + binomial_gain / 2 <=
              std::numeric_limits<std::uint16_t>::max());
static_assert(255 * binomial_gain <= largest_before_filter_unsigned);  // Q0 becomes Q4 unrounded

/// Full scale of an opponent plane from level 2 on, and what no plane exceeds there.
inline constexpr std::int32_t full_scale = 1 << 14;
inline constexpr std::int32_t largest_sample = full_scale - 1;
inline constexpr std::int32_t largest_map_sample = 2 * largest_sample;
static_assert(largest_map_sample <= std::numeric_limits<std::int16_t>::max());
static_assert(binomial_gain * binomial_gain * largest_map_sample <=
              std::numeric_limits<std::int32_t>::max() /
                  2);  // levels 3 and up: one rounding, at the end

[[nodiscard]] constexpr std::int16_t saturated(std::int32_t value) {
  return static_cast<std::int16_t>(std::clamp(value, -largest_sample, largest_sample));
}

/// Intensity: S from level 2 on is Q4, and a grey level is 3 of S.
inline constexpr int intensity_fraction_bits = 4;
inline constexpr std::int32_t samples_per_grey_level = 3 << intensity_fraction_bits;
static_assert(255 * samples_per_grey_level <= largest_sample);

/// Opponents: what corresponds to a grey level when a pure colour counts as 255 of them. Exact in
/// the robust profile (D in Q6; E, of twice the range, in Q5); full scale is 256 of them in the
/// report's.
inline constexpr std::int32_t samples_per_colour_level = 64;
static_assert(255 * samples_per_colour_level <= largest_sample);

/// Samples to a grey level of intensity, red-green and blue-yellow.
inline constexpr std::array<double, 3> plane_samples_per_grey_level{
    samples_per_grey_level, samples_per_colour_level, samples_per_colour_level};

/// Report profile: hue is 0 where r + g + b is below a tenth of full scale. Itti, Koch and Niebur
/// 1998 take a tenth of the image's maximum; the report is silent, and would divide by 0.
inline constexpr int least_sum_with_hue = 77;
inline constexpr int largest_sum = 3 * 255;

/// 2047 x 2^10 / S rounded down, 0 where there is no hue. A product with it, `(n << k) x entry`
/// rounded by 15 bits, is n/S in units of 2^-(k+6) times 2047/2048: that last factor cancels in N,
/// and with it |n| = S gives 2047 at k = 5, never 2048, whatever S.
inline constexpr std::int32_t reciprocal_scale = 2047 << 10;
inline constexpr int reciprocal_shift = 15;
inline constexpr std::array<std::int16_t, largest_sum + 1> reciprocal_table = [] {
  std::array<std::int16_t, largest_sum + 1> table{};
  for (int sum = least_sum_with_hue; sum <= largest_sum; ++sum)
    table[static_cast<std::size_t>(sum)] = static_cast<std::int16_t>(reciprocal_scale / sum);
  return table;
}();
static_assert(reciprocal_scale / least_sum_with_hue <= std::numeric_limits<std::int16_t>::max());
static_assert(rounding_shift<reciprocal_shift>(reciprocal_scale << 5) ==
              largest_before_filter_signed);

/// Conspicuity maps and S: Q16, of a largest value of 255 per map (M of the report). Twelve maps
/// are summed.
inline constexpr int conspicuity_fraction_bits = 16;
inline constexpr std::int32_t map_maximum = 255;
inline constexpr int most_maps_summed = 12;
static_assert((std::int64_t{map_maximum} << conspicuity_fraction_bits) * most_maps_summed <=
              std::numeric_limits<std::int32_t>::max());

/// The map that is handed out: Q8 of S, so that 255 is 65280.
inline constexpr int map_fraction_bits = 8;
static_assert((map_maximum << map_fraction_bits) <= std::numeric_limits<std::uint16_t>::max());

}  // namespace gazed::saliency
