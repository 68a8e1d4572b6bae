#include "agent/base/image.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>

namespace gazed::base::image_test {
namespace {

constexpr std::uint8_t padding = 0xee;

// 2x2 pixels of three bytes in rows of 8 bytes.
constexpr std::array<std::uint8_t, 16> padded_rgb{1, 2, 3, 4,  5,  6,  padding, padding,
                                                  7, 8, 9, 10, 11, 12, padding, padding};
constexpr ImageView padded_view{padded_rgb.data(), 2, 2, 8, PixelFormat::rgb24};

int luma_of_rgb(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  const std::array<std::uint8_t, 3> pixel{r, g, b};
  return luma({pixel.data(), 1, 1, 3, PixelFormat::rgb24}, 0, 0);
}

TEST(ImageView, DefaultIsEmpty) {
  EXPECT_TRUE(ImageView().empty());
  EXPECT_TRUE(Image().view().empty());
}

TEST(ImageView, RowsAreOneStrideApart) {
  EXPECT_EQ(padded_view.row(0)[0], 1);
  EXPECT_EQ(padded_view.row(1)[0], 7);
}

TEST(Luma, OfGreyIsTheByteItself) {
  const std::array<std::uint8_t, 6> bytes{0, 128, padding, 255, 7, padding};
  const ImageView view{bytes.data(), 2, 2, 3, PixelFormat::grey};
  EXPECT_EQ(luma(view, 0, 0), 0);
  EXPECT_EQ(luma(view, 1, 0), 128);
  EXPECT_EQ(luma(view, 0, 1), 255);
  EXPECT_EQ(luma(view, 1, 1), 7);
}

TEST(Luma, OfYuyvIsTheYOfEachPixelOfAPair) {
  const std::array<std::uint8_t, 10> bytes{16, 90, 235, 240, padding, 40, 90, 50, 240, padding};
  const ImageView view{bytes.data(), 2, 2, 5, PixelFormat::yuyv};
  EXPECT_EQ(luma(view, 0, 0), 16);
  EXPECT_EQ(luma(view, 1, 0), 235);
  EXPECT_EQ(luma(view, 0, 1), 40);
  EXPECT_EQ(luma(view, 1, 1), 50);
}

TEST(Luma, OfRgbKeepsBlackWhiteAndGrey) {
  for (const int value : {0, 1, 77, 128, 254, 255}) {
    const auto byte = static_cast<std::uint8_t>(value);
    EXPECT_EQ(luma_of_rgb(byte, byte, byte), value);
  }
}

TEST(Luma, OfRgbWeighsThePrimariesAsBt601) {
  // 0.299, 0.587 and 0.114 of 255, rounded.
  EXPECT_EQ(luma_of_rgb(255, 0, 0), 77);  // 76.2; in Q8 76.7
  EXPECT_EQ(luma_of_rgb(0, 255, 0), 149);
  EXPECT_EQ(luma_of_rgb(0, 0, 255), 29);
}

TEST(Luma, OfPaddedRgbReadsTheRightPixel) {
  // (77 r + 150 g + 29 b + 128) / 256 of (4, 5, 6) and (10, 11, 12).
  EXPECT_EQ(luma(padded_view, 1, 0), 5);
  EXPECT_EQ(luma(padded_view, 1, 1), 11);
}

TEST(Image, RowsAreUnpaddedAndZero) {
  Image image(3, 2, PixelFormat::yuyv);
  EXPECT_EQ(image.view().row_stride, 6);
  EXPECT_EQ(image.pixels().size(), 12U);
  EXPECT_EQ(image.row(1), image.pixels().data() + 6);
  EXPECT_EQ(std::accumulate(image.pixels().begin(), image.pixels().end(), 0), 0);
}

TEST(Image, AssignDropsThePadding) {
  Image image;
  image.assign(padded_view);
  EXPECT_EQ(image.view().width_px, 2);
  EXPECT_EQ(image.view().height_px, 2);
  EXPECT_EQ(image.view().row_stride, 6);
  EXPECT_EQ(image.view().format, PixelFormat::rgb24);
  constexpr std::array<std::uint8_t, 12> expected{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_TRUE(std::ranges::equal(image.pixels(), expected));
}

TEST(Image, AssignTakesSizeAndFormatOfTheSource) {
  Image image(4, 4, PixelFormat::rgb24);
  const std::array<std::uint8_t, 2> grey{3, 4};
  image.assign({grey.data(), 1, 2, 1, PixelFormat::grey});
  EXPECT_EQ(image.view().width_px, 1);
  EXPECT_EQ(image.view().height_px, 2);
  EXPECT_EQ(image.view().format, PixelFormat::grey);
  EXPECT_TRUE(std::ranges::equal(image.pixels(), grey));
}

TEST(Image, AssignReusesItsMemory) {
  const Image large(8, 8, PixelFormat::rgb24), small(2, 2, PixelFormat::grey);
  Image image = large;
  const std::uint8_t* const before = image.view().data;
  image.assign(small.view());
  image.assign(large.view());
  EXPECT_EQ(image.view().data, before);
}

TEST(Image, AssignFromAnEmptyViewIsEmpty) {
  Image image(2, 2, PixelFormat::grey);
  image.assign({});
  EXPECT_TRUE(image.view().empty());
}

}  // namespace
}  // namespace gazed::base::image_test
