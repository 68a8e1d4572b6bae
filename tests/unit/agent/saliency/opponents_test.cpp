#include "agent/saliency/opponents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency::opponents_test {
namespace {

using One = Opponents<std::int16_t>;

std::int16_t first_lane(lanes::I16x8 a) {
  alignas(16) std::array<std::int16_t, lane_count> all{};
  store(all.data(), a);
  return all[0];
}

One first_lane(const Opponents<lanes::I16x8>& is) {
  return {first_lane(is.intensity), first_lane(is.red_green), first_lane(is.blue_yellow)};
}

using ConvertRows = void(const ThreeRows&, int, const OpponentRows&);

/// One sample of three low-passed planes.
One of_smooth(ConvertRows convert, const std::array<std::int16_t, 3>& sample) {
  struct alignas(16) Row : std::array<std::int16_t, lane_count> {};
  std::array<Row, 3> in{}, out{};
  for (std::size_t k = 0; k < 3; ++k) in[k][0] = sample[k];
  convert({in[0].data(), in[1].data(), in[2].data()}, lane_count,
          {out[0].data(), out[1].data(), out[2].data()});
  return {out[0][0], out[1][0], out[2][0]};
}

One of_pixel(std::uint8_t r, std::uint8_t g, std::uint8_t b, bool clamp) {
  const lanes::I16x8 red = lanes::splat(r), green = lanes::splat(g), blue = lanes::splat(b);
  return first_lane(clamp ? opponents_of_pixels<true>(red, green, blue)
                          : opponents_of_pixels<false>(red, green, blue));
}

// Half a unit of rounding, and a unit of the reciprocal's: at most 4 S / (2047 2^10 / 765) = 1.1.
constexpr double pixel_tolerance = 1.7;

TEST(Opponents, PixelsAgreeWithTheFormulaAndKeepTheFiltersHeadRoom) {
  for (int r = 0; r <= 255; r += 15) {
    for (int g = 0; g <= 255; g += 15) {
      for (int b = 0; b <= 255; b += 15) {
        const One is = of_pixel(static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                                static_cast<std::uint8_t>(b), false);
        const double sum = r + g + b;
        EXPECT_EQ(is.intensity, 2 * (r + g + b));
        const double d = sum < 77 ? 0.0 : 2047.0 * (r - g) / sum;
        const double e =
            sum < 77 ? 0.0 : 2047.0 / 4 * (4 * b - 2 * r - 2 * g + std::abs(r - g)) / sum;
        EXPECT_NEAR(is.red_green, d, pixel_tolerance) << r << ' ' << g << ' ' << b;
        EXPECT_NEAR(is.blue_yellow, e, pixel_tolerance) << r << ' ' << g << ' ' << b;
        EXPECT_LE(std::abs(is.red_green), largest_before_filter_signed);
        EXPECT_LE(std::abs(is.blue_yellow), largest_before_filter_signed);
      }
    }
  }
}

TEST(Opponents, ClampedPixelsAgreeWithTheFormula) {
  const auto positive = [](double v) { return std::max(v, 0.0); };
  for (int r = 0; r <= 255; r += 17) {
    for (int g = 0; g <= 255; g += 17) {
      for (int b = 0; b <= 255; b += 17) {
        const One is = of_pixel(static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                                static_cast<std::uint8_t>(b), true);
        const double sum = r + g + b;
        const double scale = sum < 77 ? 0.0 : 2047.0 / 2 / sum;
        EXPECT_NEAR(is.red_green, scale * (positive(2 * r - g - b) - positive(2 * g - r - b)),
                    pixel_tolerance);
        EXPECT_NEAR(is.blue_yellow,
                    scale * (positive(2 * b - r - g) - positive(2 * std::min(r, g) - 2 * b)),
                    pixel_tolerance);
        EXPECT_LE(std::abs(is.red_green), largest_before_filter_signed);
        EXPECT_LE(std::abs(is.blue_yellow), largest_before_filter_signed);
      }
    }
  }
}

TEST(Opponents, HueBeginsAtASumOf77) {
  EXPECT_EQ(of_pixel(76, 0, 0, false).red_green, 0);
  EXPECT_EQ(of_pixel(77, 0, 0, false).red_green, 2047);
  EXPECT_EQ(of_pixel(0, 77, 0, false).red_green, -2047);
  EXPECT_EQ(of_pixel(0, 0, 76, false).blue_yellow, 0);
  EXPECT_EQ(of_pixel(0, 0, 77, false).blue_yellow, 2047);
}

TEST(Opponents, YuyvBecomesRgbWithinOneLevel) {
  for (int y = 16; y <= 235; y += 13) {
    for (int u = 16; u <= 240; u += 16) {
      for (int v = 16; v <= 240; v += 16) {
        const std::array<std::uint8_t, 4> yuyv{
            static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(u),
            static_cast<std::uint8_t>(235 - y + 16), static_cast<std::uint8_t>(v)};
        std::array<std::uint8_t, 6> rgb{};
        rgb_of_yuyv(yuyv.data(), 2, rgb.data());
        const double luma = (y - 16) * 255.0 / 219.0, cb = (u - 128) * 255.0 / 224.0,
                     cr = (v - 128) * 255.0 / 224.0;
        const auto cut = [](double c) { return std::clamp(c, 0.0, 255.0); };
        EXPECT_NEAR(rgb[0], cut(luma + 1.402 * cr), 0.6);
        EXPECT_NEAR(rgb[1], cut(luma - 0.344136 * cb - 0.714136 * cr), 0.6);
        EXPECT_NEAR(rgb[2], cut(luma + 1.772 * cb), 0.6);
      }
    }
  }
}

// Q7 of 255 is 32640, in each channel.
TEST(Opponents, SmoothColoursReachFullScaleAndNoMore) {
  const std::int16_t full = 255 << 7;
  for (int colour = 0; colour < 8; ++colour) {
    const std::int16_t r = colour & 1 ? full : 0, g = colour & 2 ? full : 0,
                       b = colour & 4 ? full : 0;
    const One out = of_smooth(opponents_of_smooth_rgb, {r, g, b});
    EXPECT_EQ(out.intensity, ((r + g + b) >> 7) * 16);
    EXPECT_EQ(out.red_green, ((r >> 7) - (g >> 7)) * 64);
    EXPECT_EQ(out.blue_yellow, (4 * b - 2 * r - 2 * g + std::abs(r - g)) / 8);
    EXPECT_LE(std::abs(out.red_green), largest_sample);
    EXPECT_LE(std::abs(out.blue_yellow), largest_sample);
  }
}

TEST(Opponents, SmoothYuvAgreesWithTheFormulaAndSaturates) {
  for (int y = 0; y <= 255; y += 15) {
    for (int u = 0; u <= 255; u += 15) {
      for (int v = 0; v <= 255; v += 15) {
        const auto q7 = [](int c) { return static_cast<std::int16_t>(c << 7); };
        const One out = of_smooth(opponents_of_smooth_yuv, {q7(y), q7(u), q7(v)});
        const double luma = (y - 16) * 255.0 / 219.0, cb = (u - 128) * 255.0 / 224.0,
                     cr = (v - 128) * 255.0 / 224.0;
        const double r = luma + 1.402 * cr, g = luma - 0.344136 * cb - 0.714136 * cr,
                     b = luma + 1.772 * cb;
        const auto cut = [](double s) { return std::clamp(s, -16383.0, 16383.0); };
        // Coefficients in Q12, of values up to 255: 0.06 grey levels, 16 to 64 samples each.
        EXPECT_NEAR(out.intensity, cut(16 * (r + g + b)), 3.0);
        EXPECT_NEAR(out.red_green, cut(64 * (r - g)), 4.0);
        EXPECT_NEAR(out.blue_yellow, cut(32 * (2 * b - r - g + std::abs(r - g) / 2)), 4.0);
      }
    }
  }
}

}  // namespace
}  // namespace gazed::saliency::opponents_test
