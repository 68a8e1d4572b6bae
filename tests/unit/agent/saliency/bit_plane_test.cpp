// Bits in words: the dilation against the same done sample by sample.
#include "agent/saliency/bit_plane.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

namespace gazed::saliency::bit_plane_test {
namespace {

void expect_equal(const BitPlane& a, const BitPlane& b) {
  ASSERT_EQ(a.words().size(), b.words().size());
  for (std::size_t i = 0; i < a.words().size(); ++i) ASSERT_EQ(a.words()[i], b.words()[i]);
}

TEST(BitPlane, CountsWhatIsSet) {
  BitPlane plane(80, 60);
  EXPECT_EQ(plane.count(), 0);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) plane.set(x, y);
  EXPECT_EQ(plane.count(), 4800);
}

// Widths around a word's, 32 and 64 bits.
constexpr std::array widths{1, 2, 20, 31, 32, 33, 63, 64, 65, 80, 127, 128, 129, 320};

TEST(BitPlane, DilatesByOneSampleAllRound) {
  std::mt19937_64 random(13);
  for (const int width : widths) {
    BitPlane plane(width, 9), expected(width, 9), dilated(width, 9);
    for (int n = 0; n < 1 + width / 8; ++n)
      plane.set(static_cast<int>(random() % static_cast<std::uint64_t>(width)),
                static_cast<int>(random() % 9));
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < width; ++x)
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, 8); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
            if (plane.at(u, v)) expected.set(x, y);
    dilate(plane, dilated);
    expect_equal(dilated, expected);
  }
}

}  // namespace
}  // namespace gazed::saliency::bit_plane_test
