#include "agent/saliency/opponents.hpp"

#include <algorithm>
#include <cstdlib>

#include "agent/saliency/fixed.hpp"

namespace gazed {

namespace {

struct Numerators {
  std::int32_t red_green;    // of D, already shifted so that full scale comes out as 2047
  std::int32_t blue_yellow;  // of E
};

constexpr Numerators unclamped(int r, int g, int b) {
  const int difference = r > g ? r - g : g - r;
  return {(r - g) << 5, (4 * b - 2 * r - 2 * g + difference) << 3};
}

constexpr Numerators clamped(int r, int g, int b) {
  const int red = std::max(2 * r - g - b, 0), green = std::max(2 * g - r - b, 0);
  const int blue = std::max(2 * b - r - g, 0), yellow = std::max(2 * std::min(r, g) - 2 * b, 0);
  return {(red - green) << 4, (blue - yellow) << 4};
}

constexpr std::int32_t times_reciprocal(std::int32_t numerator, int sum) {
  return rounding_shift<reciprocal_shift>(numerator *
                                          reciprocal_table[static_cast<std::size_t>(sum)]);
}

// The numerators fit in 16 bits, and the largest quotients in what the filter takes: |r-g| <= S,
// 4b-... <= 4S, 2r-g-b <= 2S, the worst case of each being a pure colour of any brightness.
static_assert(unclamped(0, 0, 255).blue_yellow <= std::numeric_limits<std::int16_t>::max());
static_assert([] {
  for (int level = least_sum_with_hue; level <= 255; ++level) {
    for (const Numerators n : {unclamped(level, 0, 0), unclamped(0, level, 0),
                               unclamped(0, 0, level), clamped(level, 0, 0), clamped(0, level, 0),
                               clamped(0, 0, level), clamped(level / 2, level - level / 2, 0)})
      if (std::max({times_reciprocal(n.red_green, level), -times_reciprocal(n.red_green, level),
                    times_reciprocal(n.blue_yellow, level),
                    -times_reciprocal(n.blue_yellow, level)}) > largest_before_filter_signed)
        return false;
  }
  return true;
}());
static_assert(2 * largest_sum <= largest_before_filter_signed);

// BT.601 limited range (ITU-R BT.601-7, 2.5.1 to 2.5.3): r = y' + 1.402 v', g = y' - 0.344136 u' -
// 0.714136 v', b = y' + 1.772 u' with y' = 255/219 (y - 16), u' = 255/224 (u - 128), v' likewise.
constexpr int yuv_bits = 12;  // coefficients in Q12
constexpr std::int32_t y_per_y = 4769;
constexpr std::int32_t red_per_v = 6537;
constexpr std::int32_t green_per_u = -1605;
constexpr std::int32_t green_per_v = -3330;
constexpr std::int32_t blue_per_u = 8263;

constexpr std::int32_t d_per_u = -green_per_u;
constexpr std::int32_t d_per_v = red_per_v - green_per_v;
constexpr std::int32_t e_per_u = 2 * blue_per_u - green_per_u;
constexpr std::int32_t e_per_v = -red_per_v - green_per_v;
constexpr std::int32_t s_per_y = 3 * y_per_y;
constexpr std::int32_t s_per_u = green_per_u + blue_per_u;
constexpr std::int32_t s_per_v = red_per_v + green_per_v;

constexpr std::uint8_t byte_of(std::int32_t q12) {
  return static_cast<std::uint8_t>(std::clamp(rounding_shift<yuv_bits>(q12), 0, 255));
}

}  // namespace

void opponents_of_pixels(const std::uint8_t* rgb, int width, bool clamp_negative,
                         const OpponentRows& out) {
  const auto convert = [&](auto numerators_of) {
    for (int x = 0; x < width; ++x) {
      const int r = rgb[3 * x], g = rgb[3 * x + 1], b = rgb[3 * x + 2];
      const int sum = r + g + b;
      const Numerators n = numerators_of(r, g, b);
      out.intensity[x] = static_cast<std::int16_t>(2 * sum);
      out.red_green[x] = static_cast<std::int16_t>(times_reciprocal(n.red_green, sum));
      out.blue_yellow[x] = static_cast<std::int16_t>(times_reciprocal(n.blue_yellow, sum));
    }
  };
  if (clamp_negative) {
    convert([](int r, int g, int b) { return clamped(r, g, b); });
  } else {
    convert([](int r, int g, int b) { return unclamped(r, g, b); });
  }
}

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

void opponents_of_smooth_rgb(const std::uint16_t* r, const std::uint16_t* g, const std::uint16_t* b,
                             int width, const OpponentRows& out) {
  for (int x = 0; x < width; ++x) {
    const std::int32_t red = r[x], green = g[x], blue = b[x];
    const std::int32_t difference = red - green;
    out.intensity[x] = static_cast<std::int16_t>(rounding_shift<3>(red + green + blue));
    out.red_green[x] = static_cast<std::int16_t>(rounding_shift<1>(difference));
    out.blue_yellow[x] = static_cast<std::int16_t>(
        rounding_shift<3>(2 * (2 * blue - red - green) + std::abs(difference)));
  }
}

void opponents_of_smooth_yuv(const std::uint16_t* y, const std::uint16_t* u, const std::uint16_t* v,
                             int width, const OpponentRows& out) {
  constexpr int input_bits = 7;                        // Q7
  constexpr int product_bits = input_bits + yuv_bits;  // Q19; the largest sum is below 2^30
  static_assert(std::int64_t{s_per_y} * (239 << input_bits) +
                    std::int64_t{s_per_u + s_per_v} * (128 << input_bits) <
                1 << 30);
  for (int x = 0; x < width; ++x) {
    const std::int32_t luma = y[x] - (16 << input_bits);
    const std::int32_t blue = u[x] - (128 << input_bits), red = v[x] - (128 << input_bits);
    const std::int32_t d = d_per_u * blue + d_per_v * red;
    const std::int32_t e = e_per_u * blue + e_per_v * red + std::abs(d) / 2;
    const std::int32_t s = s_per_y * luma + s_per_u * blue + s_per_v * red;
    out.intensity[x] = saturated(rounding_shift<product_bits - 4>(s));
    out.red_green[x] = saturated(rounding_shift<product_bits - 6>(d));
    out.blue_yellow[x] = saturated(rounding_shift<product_bits - 5>(e));
  }
}

}  // namespace gazed
