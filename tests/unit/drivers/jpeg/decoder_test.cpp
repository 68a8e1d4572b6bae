#include "drivers/jpeg/decoder.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <span>
#include <string>

#include "files.hpp"
#include "tests/unit/allocations.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::jpeg::decoder_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int width_px = 80, height_px = 48;
// Quality 95 quantises luma by up to 12 and halves the colours' resolution; measured: 9.
constexpr int tolerance = 12;

std::string problem_of(const Bytes& file) {
  base::Image image;
  return decode(file, width_px, height_px, image);
}

/// The pixels of a sound file.
base::Image decoded(const Bytes& file) {
  base::Image image;
  EXPECT_EQ(decode(file, width_px, height_px, image), "");
  return image;
}

bool same(base::Image a, base::Image b) {
  return std::ranges::equal(a.pixels(), b.pixels());
}

int largest_difference(const base::ImageView& a, const base::ImageView& b, int b_step = 1) {
  int largest = 0;
  for (int y = 0; y < a.height_px; ++y) {
    for (int i = 0; i < a.row_stride; ++i)
      largest = std::max(largest, std::abs(a.row(y)[i] - b.row(y)[i * b_step]));
  }
  return largest;
}

TEST(Decode, ColoursComeAsRgb) {
  const base::Image image = waves(width_px, height_px);
  const base::Image found = decoded(file_of(image));
  ASSERT_EQ(found.view().format, base::PixelFormat::rgb24);
  EXPECT_LE(largest_difference(found.view(), image.view()), tolerance);
}

TEST(Decode, GreyComesAsGrey) {
  const base::Image image = waves(width_px, height_px);
  const base::Image found = decoded(file_of(image, {.colours = 1}));
  ASSERT_EQ(found.view().format, base::PixelFormat::grey);
  EXPECT_LE(largest_difference(found.view(), image.view(), 3), tolerance);
}

TEST(Decode, RestartMarkersAreRead) {
  const base::Image image = waves(width_px, height_px);
  EXPECT_TRUE(same(decoded(file_of(image, {.restart_rows = 1})), decoded(file_of(image))));
}

TEST(Decode, AFrameWithoutItsHuffmanTablesHasTheUsualOnes) {
  constexpr std::uint8_t define_huffman_table = 0xC4;
  const Bytes file = file_of(waves(width_px, height_px));
  const Bytes bare = without_segments(file, define_huffman_table);
  ASSERT_LT(bare.size(), file.size());
  EXPECT_TRUE(same(decoded(bare), decoded(file)));
}

TEST(Decode, TheEndMarkerMayBeMissing) {
  const Bytes file = file_of(waves(width_px, height_px));
  for (const std::ptrdiff_t cut : {1, 2})
    EXPECT_TRUE(same(decoded(Bytes(file.begin(), file.end() - cut)), decoded(file))) << cut;
}

TEST(Decode, PaddingAndStrayBytesAtTheEndHarmNothing) {
  const Bytes file = file_of(waves(width_px, height_px));
  Bytes padded = file;
  padded.insert(padded.end(), 1000, 0);
  EXPECT_TRUE(same(decoded(padded), decoded(file)));
  Bytes stray = file;
  stray.insert(stray.end() - 2, 3, 0x55);  // before the end marker, as many cameras send them
  EXPECT_TRUE(same(decoded(stray), decoded(file)));
}

TEST(Decode, AScanMayLeaveItsParametersAtZero) {
  const Bytes file = file_of(waves(width_px, height_px));
  Bytes zeros = file;
  constexpr std::array<std::uint8_t, 2> start_of_scan{0xFF, 0xDA};
  const auto scan = std::ranges::search(zeros, start_of_scan).begin();
  ASSERT_NE(scan, zeros.end());
  // Marker, length, number of colours, two bytes a colour; then the parameters (ITU-T T.81, B.2.3).
  std::fill_n(scan + 5 + 2 * scan[4], 3, std::uint8_t{0});
  ASSERT_NE(zeros, file);
  EXPECT_TRUE(same(decoded(zeros), decoded(file)));
}

TEST(Decode, ACutFrameIsRefused) {
  for (const unsigned restart_rows : {0U, 1U}) {
    const Bytes file = file_of(waves(width_px, height_px), {.restart_rows = restart_rows});
    // The last bytes of a scan may be padding alone.
    for (std::size_t length = 0; length + 4 < file.size(); ++length) {
      const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
      ASSERT_NE(problem_of(cut), "") << length << " of " << file.size();
    }
  }
  const Bytes file = file_of(waves(width_px, height_px));
  const Bytes half(file.begin(), file.end() - static_cast<std::ptrdiff_t>(file.size() / 4));
  EXPECT_THAT(problem_of(half), StartsWith("a damaged JPEG: "));
}

TEST(Decode, AnotherSizeIsRefusedWithBoth) {
  base::Image image;
  EXPECT_EQ(decode(file_of(waves(width_px, height_px)), 640, 480, image),
            "a JPEG of 80x48 pixels where the frame has 640x480");
  EXPECT_TRUE(image.view().empty()) << "no memory is taken for it";
}

TEST(Decode, WhatNoCameraSendsIsRefused) {
  const base::Image image = waves(width_px, height_px);
  EXPECT_THAT(problem_of(file_of(image, {.progressive = true})), HasSubstr("progressive"));
  EXPECT_THAT(problem_of(file_of(image, {.arithmetic = true})), HasSubstr("arithmetic"));
  EXPECT_THAT(problem_of(file_of(image, {.colours = 4})), HasSubstr("4 colours"));
  EXPECT_EQ(problem_of({}), "a JPEG of no bytes");
  EXPECT_THAT(problem_of({'P', '6', ' ', '1'}), StartsWith("no JPEG that can be read: "));
}

TEST(Decode, AnyDamageEndsInWordsOrPixels) {
  const Bytes sound = file_of(waves(width_px, height_px), {.restart_rows = 2});
  std::mt19937_64 random(1);
  int refused = 0, taken = 0;
  for (int i = 0; i < test::trials(20'000, 1'000); ++i) {
    Bytes file = sound;
    for (auto changes = 1 + random() % 4; changes > 0; --changes)
      file[random() % file.size()] = static_cast<std::uint8_t>(random());
    base::Image image;
    if (decode(file, width_px, height_px, image).empty()) {
      ++taken;
      ASSERT_EQ(image.view().width_px, width_px);
      ASSERT_EQ(image.view().height_px, height_px);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(taken, 0) << "a wrong coefficient is no damage that can be seen";
}

TEST(Decode, AllocatesNoImageAfterTheFirst) {
  const Bytes file = file_of(waves(width_px, height_px));
  base::Image image;
  ASSERT_EQ(decode(file, width_px, height_px, image), "");
  const long before = test::allocations();
  for (int i = 0; i < 10; ++i) static_cast<void>(decode(file, width_px, height_px, image));
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace gazed::jpeg::decoder_test
