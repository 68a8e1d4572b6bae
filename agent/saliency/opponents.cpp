#include "agent/saliency/opponents.hpp"

#include <algorithm>
#include <limits>

namespace gazed::saliency {

using namespace lanes;

namespace {

// The numerators fit in 16 bits, and the quotients in what the filter takes: |r-g| <= S, 4b-... <=
// 4S, 2r-g-b <= 2S, the worst case of each being a pure colour of any brightness.
template <bool clamp_negative>
constexpr bool leaves_room(int r, int g, int b) {
  const auto all = [](int value) { return plain::splat(static_cast<std::int16_t>(value)); };
  const auto is = opponents_of_pixels<clamp_negative>(all(r), all(g), all(b));
  const auto fits = [](plain::I16x8 v) {
    return v.lane[0] <= largest_before_filter_signed && v.lane[0] >= -largest_before_filter_signed;
  };
  return fits(is.intensity) && fits(is.red_green) && fits(is.blue_yellow);
}
static_assert((4 * 255) << 3 <= std::numeric_limits<std::int16_t>::max());
#ifndef __clang__  // clang 16 does not evaluate elements of vectors at compile time
static_assert([] {
  for (int level = least_sum_with_hue; level <= 255; ++level) {
    if (!leaves_room<false>(level, 0, 0) || !leaves_room<false>(0, level, 0) ||
        !leaves_room<false>(0, 0, level) || !leaves_room<true>(level, 0, 0) ||
        !leaves_room<true>(0, level, 0) || !leaves_room<true>(0, 0, level) ||
        !leaves_room<true>(level / 2, level - level / 2, 0))
      return false;
  }
  return leaves_room<false>(255, 255, 255);
}());
#endif

// BT.601 limited range (ITU-R BT.601-7, 2.5.1 to 2.5.3): r = y' + 1.402 v', g = y' - 0.344136 u' -
// 0.714136 v', b = y' + 1.772 u' with y' = 255/219 (y - 16), u' = 255/224 (u - 128), v' likewise.
constexpr int yuv_bits = 12;  // coefficients in Q12
constexpr std::int16_t y_per_y = 4769;
constexpr std::int16_t red_per_v = 6537;
constexpr std::int16_t green_per_u = -1605;
constexpr std::int16_t green_per_v = -3330;
constexpr std::int16_t blue_per_u = 8263;

constexpr std::int16_t d_per_u = -green_per_u;
constexpr std::int16_t d_per_v = red_per_v - green_per_v;
constexpr std::int16_t e_per_u = 2 * blue_per_u - green_per_u;
constexpr std::int16_t e_per_v = -red_per_v - green_per_v;
constexpr std::int16_t s_per_y = 3 * y_per_y;
constexpr std::int16_t s_per_u = green_per_u + blue_per_u;
constexpr std::int16_t s_per_v = red_per_v + green_per_v;

constexpr std::uint8_t byte_of(std::int32_t q12) {
  return static_cast<std::uint8_t>(std::clamp(rounding_shift<yuv_bits>(q12), 0, 255));
}

constexpr int smooth_bits = 7;                        // Q7
constexpr int product_bits = smooth_bits + yuv_bits;  // Q19; the largest sum is below 2^30
static_assert(std::int64_t{s_per_y} * (239 << smooth_bits) +
                  std::int64_t{s_per_u + s_per_v} * (128 << smooth_bits) <
              1 << 30);
static_assert((std::int64_t{e_per_u} - e_per_v + (d_per_u + d_per_v) / 2) * (128 << smooth_bits) <
              1 << 30);

struct Sums {
  I32x4 low, high;

  template <int bits>
  [[nodiscard]] I16x8 rounded() const {
    const I32x4 half = splat_sum(1 << (bits - 1));
    return packed(shifted_right<bits>(low + half), shifted_right<bits>(high + half));
  }
};

Sums operator+(const Sums& a, const Sums& b) {
  return {a.low + b.low, a.high + b.high};
}

/// a_weight a + b_weight b.
Sums weighted(I16x8 a, std::int16_t a_weight, I16x8 b, std::int16_t b_weight) {
  const I16x8 weights = alternating(a_weight, b_weight);
  return {pair_sums(interleaved_low(a, b), weights), pair_sums(interleaved_high(a, b), weights)};
}

I16x8 saturated(I16x8 a) {
  return larger(smaller(a, splat(largest_sample)), splat(-largest_sample));
}

Opponents<I16x8> of_smooth_rgb(I16x8 r, I16x8 g, I16x8 b) {
  const I16x8 difference = r - g, half = splat(4);  // half of the 8 that is shifted away
  const auto shifted = [](const Sums& s) {
    return packed(shifted_right<3>(s.low), shifted_right<3>(s.high));
  };
  return {shifted(weighted(r, 1, g, 1) + weighted(b, 1, half, 1)),
          shifted_right<1>(difference + splat(1)),
          shifted(weighted(b - r, 2, b - g, 2) + weighted(magnitude(difference), 1, half, 1))};
}

Opponents<I16x8> of_smooth_yuv(I16x8 y, I16x8 u, I16x8 v) {
  const I16x8 middle = splat(128 << smooth_bits);
  const I16x8 luma = y - splat(16 << smooth_bits), blue = u - middle, red = v - middle;
  const Sums d = weighted(blue, d_per_u, red, d_per_v);
  const Sums half_d{shifted_right<1>(magnitude(d.low)), shifted_right<1>(magnitude(d.high))};
  const Sums e = weighted(blue, e_per_u, red, e_per_v) + half_d;
  const Sums s = weighted(luma, s_per_y, blue, s_per_u) + weighted(red, s_per_v, I16x8{}, 0);
  return {saturated(s.rounded<product_bits - 4>()), saturated(d.rounded<product_bits - 6>()),
          saturated(e.rounded<product_bits - 5>())};
}

template <typename Kernel>
void convert_rows(const ThreeRows& in, int samples, const OpponentRows& out, Kernel kernel) {
  const auto [a, b, c] = in;
  const auto [intensity, red_green, blue_yellow] = out;
  for (int x = 0; x < samples; x += lane_count) {
    const Opponents<I16x8> is = kernel(load(a + x), load(b + x), load(c + x));
    store(intensity + x, is.intensity);
    store(red_green + x, is.red_green);
    store(blue_yellow + x, is.blue_yellow);
  }
}

}  // namespace

void rgb_of_yuyv(const std::uint8_t* yuyv, int width, std::uint8_t* rgb) {
  for (int x = 0; x < width; x += 2) {
    const int u = yuyv[2 * x + 1] - 128, v = yuyv[2 * x + 3] - 128;
    for (int k = 0; k < 2; ++k) {
      const std::int32_t luma = y_per_y * (yuyv[2 * (x + k)] - 16);
      std::uint8_t* pixel = rgb + 3 * (x + k);
      pixel[0] = byte_of(luma + red_per_v * v);
      pixel[1] = byte_of(luma + green_per_u * u + green_per_v * v);
      pixel[2] = byte_of(luma + blue_per_u * u);
    }
  }
}

void opponents_of_smooth_rgb(const ThreeRows& rgb, int samples, const OpponentRows& out) {
  convert_rows(rgb, samples, out, [](I16x8 r, I16x8 g, I16x8 b) { return of_smooth_rgb(r, g, b); });
}

void opponents_of_smooth_yuv(const ThreeRows& yuv, int samples, const OpponentRows& out) {
  convert_rows(yuv, samples, out, [](I16x8 y, I16x8 u, I16x8 v) { return of_smooth_yuv(y, u, v); });
}

}  // namespace gazed::saliency
