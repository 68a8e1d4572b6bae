// From camera pixels to intensity and the two opponent colours (SPEC 1.1.1, 1.2.4), a row at a
// time.
//
// The formats are those of fixed.hpp. With r' = r/I and so on, R - G = 4.5 (r-g)/S and
// B - Y = 1.5 (4b-2r-2g+|r-g|)/S, S = r+g+b: the constant factors cancel in N and are left out.
#pragma once

#include <cstdint>

namespace gazed {

/// One row of the three planes of a pyramid level, each of the same width.
struct OpponentRows {
  std::int16_t* intensity = nullptr;    // S
  std::int16_t* red_green = nullptr;    // D
  std::int16_t* blue_yellow = nullptr;  // E
};

/// Report profile, `width` pixels r, g, b to level 0. With `clamp_negative`, R, G, B and Y are cut
/// off at 0 before they are subtracted; D and E are then in Q10.
void opponents_of_pixels(const std::uint8_t* rgb, int width, bool clamp_negative,
                         const OpponentRows& out);

/// A row of YUYV (BT.601, limited range) to r, g, b, rounded and cut off at 0 and 255. `width` is
/// even.
void rgb_of_yuyv(const std::uint8_t* yuyv, int width, std::uint8_t* rgb);

/// Robust profile: the opponents of low-passed r, g, b in Q7.
void opponents_of_smooth_rgb(const std::uint16_t* r, const std::uint16_t* g, const std::uint16_t* b,
                             int width, const OpponentRows& out);

/// Robust profile: the opponents of low-passed y, u, v in Q7 (BT.601, limited range). Colours that
/// no r, g, b can show saturate.
void opponents_of_smooth_yuv(const std::uint16_t* y, const std::uint16_t* u, const std::uint16_t* v,
                             int width, const OpponentRows& out);

}  // namespace gazed
