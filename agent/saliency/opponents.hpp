// From camera pixels to intensity and the two opponent colours (agent/saliency/README.md).
//
// The formats are those of fixed.hpp. With r' = r/I and so on, R - G = 4.5 (r-g)/S and
// B - Y = 1.5 (4b-2r-2g+|r-g|)/S, S = r+g+b: the constant factors cancel in N and are left out.
#pragma once

#include <array>
#include <cstdint>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/lanes.hpp"

namespace gazed::saliency {

/// Eight pixels, or eight samples of a level.
template <typename I16x8>
struct Opponents {
  I16x8 intensity;    // S
  I16x8 red_green;    // D
  I16x8 blue_yellow;  // E
};

/// Report profile, r, g, b from 0 to 255 to level 0. With `clamp_negative`, R, G, B and Y are cut
/// off at 0 before they are subtracted; D and E are then in Q10.
template <bool clamp_negative, typename I16x8>
[[nodiscard]] constexpr Opponents<I16x8> opponents_of_pixels(I16x8 r, I16x8 g, I16x8 b) {
  const I16x8 red_and_green = r + g;
  const I16x8 sum = red_and_green + b;
  const I16x8 reciprocal = looked_up(reciprocal_table.data(), sum);
  // Numerators, shifted so that full scale comes out as 2047.
  I16x8 d, e;
  if constexpr (clamp_negative) {
    const auto positive = [](I16x8 v) { return larger(v, I16x8{}); };
    const I16x8 red = positive(r + r - g - b), green = positive(g + g - r - b);
    const I16x8 blue = positive(b + b - red_and_green), least = smaller(r, g);
    d = shifted_left<4>(red - green);
    e = shifted_left<4>(blue - positive(least + least - b - b));
  } else {
    const I16x8 difference = r - g, half = b + b - red_and_green;
    d = shifted_left<5>(difference);
    e = shifted_left<3>(half + half + magnitude(difference));
  }
  return {sum + sum, times_q15(d, reciprocal), times_q15(e, reciprocal)};
}

/// A row of YUYV (BT.601, limited range) to r, g, b, rounded and cut off at 0 and 255. `width` is
/// even.
void rgb_of_yuyv(const std::uint8_t* yuyv, int width, std::uint8_t* rgb);

/// A row of `samples` in three planes, padded.
struct OpponentRows {
  std::int16_t* intensity = nullptr;
  std::int16_t* red_green = nullptr;
  std::int16_t* blue_yellow = nullptr;
};
using ThreeRows = std::array<const std::int16_t*, 3>;

/// Robust profile: the opponents of low-passed r, g, b in Q7.
void opponents_of_smooth_rgb(const ThreeRows& rgb, int samples, const OpponentRows& out);

/// Robust profile: the opponents of low-passed y, u, v in Q7 (BT.601, limited range). Colours that
/// no r, g, b can show saturate.
void opponents_of_smooth_yuv(const ThreeRows& yuv, int samples, const OpponentRows& out);

}  // namespace gazed::saliency
