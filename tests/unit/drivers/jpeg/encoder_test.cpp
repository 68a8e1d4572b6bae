#include "drivers/jpeg/encoder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include "drivers/jpeg/decoder.hpp"

#include "files.hpp"
#include "tests/unit/allocations.hpp"

namespace gazed::jpeg::encoder_test {
namespace {

using base::PixelFormat;

/// Decoded again.
base::Image seen(const base::ImageView& image, int quality) {
  Encoder encoder(quality);
  base::Image found;
  EXPECT_EQ(decode(encoder.encode(image), image.width_px, image.height_px, found), "");
  return found;
}

/// A patch of one colour as YUYV.
base::Image yuyv_patch(int width_px, int height_px, std::uint8_t y, std::uint8_t u,
                       std::uint8_t v) {
  base::Image image(width_px, height_px, PixelFormat::yuyv);
  for (std::size_t i = 0; i < image.pixels().size(); ++i)
    image.pixels()[i] = i % 2 == 0 ? y : i % 4 == 1 ? u : v;
  return image;
}

TEST(Encode, RgbAndGreySurviveIt) {
  // Quality 95 quantises by up to 12 and halves the colours' resolution; measured: 9.
  constexpr int tolerance = 12;
  base::Image image = waves(96, 64);
  base::Image found = seen(image.view(), 95);
  ASSERT_EQ(found.view().format, PixelFormat::rgb24);
  for (std::size_t i = 0; i < found.pixels().size(); ++i)
    ASSERT_NEAR(found.pixels()[i], image.pixels()[i], tolerance) << i;
  base::Image grey(96, 64, PixelFormat::grey);
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) grey.pixels()[i] = image.pixels()[3 * i];
  found = seen(grey.view(), 95);
  ASSERT_EQ(found.view().format, PixelFormat::grey);
  for (std::size_t i = 0; i < found.pixels().size(); ++i)
    ASSERT_NEAR(found.pixels()[i], grey.pixels()[i], tolerance) << i;
}

struct Colour {
  std::array<std::uint8_t, 3> yuv;
  std::array<int, 3> rgb;
};

TEST(Encode, ColoursOfYuyvAreThoseThatItsRangeMeans) {
  // Colour bars of 100 %, BT.601 limited range (ITU-R BT.601-7): y u v and what they mean.
  constexpr std::array bars{
      Colour{{235, 128, 128}, {255, 255, 255}}, Colour{{16, 128, 128}, {0, 0, 0}},
      Colour{{81, 90, 240}, {255, 0, 0}},       Colour{{145, 54, 34}, {0, 255, 0}},
      Colour{{41, 240, 110}, {0, 0, 255}},      Colour{{126, 128, 128}, {128, 128, 128}}};
  // The table's numbers are whole ones, 1 of chroma is 2 of blue, and both directions round.
  constexpr int tolerance = 4;
  for (const Colour& bar : bars) {
    const base::Image patch = yuyv_patch(32, 16, bar.yuv[0], bar.yuv[1], bar.yuv[2]);
    const base::Image found = seen(patch.view(), 95);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(found.view().row(8)[3 * 16 + c], bar.rgb[c], tolerance) << int{bar.yuv[0]};
  }
}

TEST(Encode, AnyWidthAndPaddedRows) {
  for (const int width_px : {1, 2, 3, 15, 17, 33}) {
    const int row_bytes = 2 * width_px;
    // Behind the last row's pixels nothing is read, which the address sanitizer sees.
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * (row_bytes + 5) + row_bytes),
                                     128);
    const base::ImageView view{pixels.data(), width_px, 4, row_bytes + 5, PixelFormat::yuyv};
    const base::Image found = seen(view, 80);
    EXPECT_NEAR(found.view().row(0)[0], 130, 3) << width_px;  // (128 - 16) * 255 / 219
  }
}

TEST(Encode, QualityDecidesTheSize) {
  const base::Image image = waves(320, 240);
  Encoder poor(20), usual(80), good(95);
  const std::size_t least = poor.encode(image.view()).size();
  const std::size_t middle = usual.encode(image.view()).size();
  EXPECT_LT(least, middle);
  EXPECT_LT(middle, good.encode(image.view()).size());
}

TEST(Encode, NoiseThatNeedsMoreRoomThanIsKeptGetsIt) {
  base::Image noise(160, 120, PixelFormat::rgb24);
  std::mt19937_64 random(1);
  for (std::uint8_t& byte : noise.pixels()) byte = static_cast<std::uint8_t>(random());
  Encoder encoder(100);
  for (int i = 0; i < 2; ++i) {
    base::Image found;
    const auto file = encoder.encode(noise.view());
    EXPECT_GT(file.size(), 160U * 120U + 4096U);
    EXPECT_EQ(decode(file, 160, 120, found), "");
  }
}

TEST(Encode, AllocatesNothingAfterTheFirst) {
  const base::Image image = yuyv_patch(64, 48, 100, 90, 80);
  Encoder encoder(80);
  ASSERT_FALSE(encoder.encode(image.view()).empty());
  const long before = test::allocations();
  for (int i = 0; i < 10; ++i) static_cast<void>(encoder.encode(image.view()));
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace gazed::jpeg::encoder_test
