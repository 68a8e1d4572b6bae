// The number formats of the saliency stage.
//
// Qn: an integer that stands for itself divided by 2^n. A plane's `full scale` is the value of pure
// red (red-green), pure blue (blue-yellow) or white (intensity). What a format must leave room for
// is the gain of 16 of the filter [1 4 6 4 1] before it is shifted away, so that every step below
// level 2 fits in 16 bits, eight samples to an SSE register.
//
//   profile  plane                        range          level 0      level 1      level 2 and up
//   report   S = r + g + b                0 .. 765       Q1   1530    Q1           Q4  12240
//   report   D = (r - g) / S             -1 .. 1         Q11  2047    Q11          Q14 16376
//   report   E = (4b-2r-2g+|r-g|) / S    -2 .. 4         Q9   2047    Q9           Q12 16376
//   robust   r, g, b or Y, U, V           0 .. 255       Q0    255    Q4   4080    Q7  32640
//   robust   S = r + g + b                0 .. 765                                 Q4  12240
//   robust   D = r - g                 -255 .. 255                                 Q6  16320
//   robust   E = 2b - r - g + |r-g|/2  -510 .. 510                                 Q5  16320
//
// From level 2 on every |value| < 2^14, so the sum and the difference of two fit in 16 bits and a
// centre-surround map is at most 2^15 - 1. Both profiles meet there in the same units: full scale
// of an opponent plane is 2^14, a grey level of intensity is 48.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace gazed {

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
inline constexpr int kBinomialGain = 16;
inline constexpr int kBinomialGainLog2 = 4;

/// Largest |value| that one pass of the filter takes in 16 bits, with the half that rounds it.
inline constexpr std::int32_t kLargestBeforeFilterSigned = 2047;
inline constexpr std::int32_t kLargestBeforeFilterUnsigned = 4080;
static_assert(kBinomialGain * kLargestBeforeFilterSigned + kBinomialGain / 2 <=
              std::numeric_limits<std::int16_t>::max());
static_assert(kBinomialGain * kLargestBeforeFilterUnsigned + kBinomialGain / 2 <=
              std::numeric_limits<std::uint16_t>::max());
static_assert(255 * kBinomialGain <= kLargestBeforeFilterUnsigned);  // Q0 becomes Q4 unrounded

/// Full scale of an opponent plane from level 2 on, and what no plane exceeds there.
inline constexpr std::int32_t kFullScale = 1 << 14;
inline constexpr std::int32_t kLargest = kFullScale - 1;
inline constexpr std::int32_t kLargestMapSample = 2 * kLargest;
static_assert(kLargestMapSample <= std::numeric_limits<std::int16_t>::max());
static_assert(kBinomialGain * kBinomialGain * kLargestMapSample <=
              std::numeric_limits<std::int32_t>::max() /
                  2);  // levels 3 and up: one rounding, at the end

[[nodiscard]] constexpr std::int16_t saturated(std::int32_t value) {
  return static_cast<std::int16_t>(std::clamp(value, -kLargest, kLargest));
}

/// Intensity: S from level 2 on is Q4, and a grey level is 3 of S.
inline constexpr int kIntensityFractionBits = 4;
inline constexpr std::int32_t kGreyLevel = 3 << kIntensityFractionBits;
static_assert(255 * kGreyLevel <= kLargest);

/// Report profile: hue is 0 where r + g + b is below a tenth of full scale (SPEC 1.1.1).
inline constexpr int kLeastSumWithHue = 77;
inline constexpr int kLargestSum = 3 * 255;

/// 2047 x 2^10 / S rounded down, 0 where there is no hue. A product with it, `(n << k) x entry`
/// rounded by 15 bits, is n/S in units of 2^-(k+6) times 2047/2048: that last factor cancels in N,
/// and with it |n| = S gives 2047 at k = 5, never 2048, whatever S.
inline constexpr std::int32_t kReciprocalScale = 2047 << 10;
inline constexpr int kReciprocalShift = 15;
inline constexpr std::array<std::int16_t, kLargestSum + 1> kReciprocal = [] {
  std::array<std::int16_t, kLargestSum + 1> table{};
  for (int sum = kLeastSumWithHue; sum <= kLargestSum; ++sum)
    table[static_cast<std::size_t>(sum)] = static_cast<std::int16_t>(kReciprocalScale / sum);
  return table;
}();
static_assert(kReciprocalScale / kLeastSumWithHue <= std::numeric_limits<std::int16_t>::max());
static_assert(rounding_shift<kReciprocalShift>(kReciprocalScale << 5) ==
              kLargestBeforeFilterSigned);

/// Conspicuity maps and S: Q16, of a largest value of 255 per map (M of the report). Twelve maps
/// are summed.
inline constexpr int kConspicuityFractionBits = 16;
inline constexpr std::int32_t kMapMaximum = 255;
inline constexpr int kMostMapsSummed = 12;
static_assert((std::int64_t{kMapMaximum} << kConspicuityFractionBits) * kMostMapsSummed <=
              std::numeric_limits<std::int32_t>::max());

/// The map that is handed out: Q8 of S, so that 255 is 65280.
inline constexpr int kMapFractionBits = 8;
static_assert((kMapMaximum << kMapFractionBits) <= std::numeric_limits<std::uint16_t>::max());

}  // namespace gazed
