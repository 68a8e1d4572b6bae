#include "agent/tracking/luma.hpp"

#include <array>
#include <cstdint>
#include <gmock/gmock.h>
#include <random>

namespace gazed::tracking::luma_test {
namespace {

constexpr int width = 66, height = 50;
// Each level rounds twice, to a sixteenth of a grey level, halves upwards.
constexpr double rounding_levels = 0.2;

template <typename Grey>
base::Image painted(base::PixelFormat format, Grey grey) {
  base::Image image(width, height, format);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto value = static_cast<std::uint8_t>(grey(x, y));
      std::uint8_t* at = image.row(y) + x * base::bytes_per_pixel(format);
      at[0] = value;
      if (format == base::PixelFormat::yuyv) at[1] = 128;
      if (format == base::PixelFormat::rgb24) at[1] = at[2] = value;
    }
  }
  return image;
}

double grey_at(const LumaLevel& level, int x, int y) {
  return level.row(y)[x] / static_cast<double>(luma_one);
}

// A ramp goes through every filter unchanged, and tells where samples lie: sample i of level k is
// centred on pixel 2^k i.
TEST(LumaPyramid, SamplesLieOnEveryOtherPixel) {
  for (const base::PixelFormat format :
       {base::PixelFormat::grey, base::PixelFormat::rgb24, base::PixelFormat::yuyv}) {
    LumaPyramid pyramid(width, height);
    const base::Image image = painted(format, [](int x, int y) { return 20 + 2 * x + y; });
    pyramid.build(image.view());
    for (int k = 0; k < LumaPyramid::level_count; ++k) {
      const LumaLevel& level = pyramid.level(k);
      EXPECT_EQ(level.step_px, 1 << k);
      const int border = 6 >> k;
      for (int y = border; y < level.height - border; ++y) {
        for (int x = border; x < level.width - border; ++x) {
          const double expected = 20 + level.step_px * (2 * x + y);
          ASSERT_NEAR(grey_at(level, x, y), expected, rounding_levels) << k << " " << x << " " << y;
        }
      }
    }
  }
}

TEST(LumaPyramid, WhiteAndBlackDoNotWrap) {
  for (const int grey : {0, 255}) {
    LumaPyramid pyramid(width, height);
    pyramid.build(painted(base::PixelFormat::rgb24, [grey](int, int) { return grey; }).view());
    for (int k = 0; k < LumaPyramid::level_count; ++k) {
      const LumaLevel& level = pyramid.level(k);
      for (int y = 0; y < level.height; ++y) {
        for (int x = 0; x < level.width; ++x) ASSERT_EQ(grey_at(level, x, y), grey);
      }
    }
  }
}

// (77 r + 150 g + 29 b) / 256, smoothed by [1 2 1]/4 both ways.
TEST(LumaPyramid, SmoothsAsItSays) {
  std::mt19937 random(3);
  base::Image image(width, height, base::PixelFormat::rgb24);
  for (std::uint8_t& byte : image.pixels()) byte = static_cast<std::uint8_t>(random() >> 24);
  const base::ImageView view = image.view();
  LumaPyramid pyramid(width, height);
  pyramid.build(view);
  constexpr std::array<double, 3> filter = {0.25, 0.5, 0.25};
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      double expected = 0.0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const std::uint8_t* at = view.row(y + j) + 3 * (x + i);
          expected += filter[static_cast<std::size_t>(i + 1)] *
                      filter[static_cast<std::size_t>(j + 1)] *
                      (77.0 * at[0] + 150.0 * at[1] + 29.0 * at[2]) / 256.0;
        }
      }
      ASSERT_NEAR(grey_at(pyramid.level(0), x, y), expected, rounding_levels);
    }
  }
}

}  // namespace
}  // namespace gazed::tracking::luma_test
