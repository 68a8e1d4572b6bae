// Bits in words: the flood and the dilation against the same done sample by sample.
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

BitPlane drawn(const std::vector<std::string_view>& rows) {
  BitPlane plane(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < plane.height(); ++y)
    for (int x = 0; x < plane.width(); ++x)
      if (rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#') plane.set(x, y);
  return plane;
}

BitPlane flooded(const BitPlane& mask) {
  BitPlane reached(mask.width(), mask.height());
  std::ranges::fill(reached.words(), ~BitPlane::Word{0});  // whatever was there before
  flood_from_border(mask, reached);
  return reached;
}

BitPlane flooded_by_samples(const BitPlane& mask) {
  BitPlane reached(mask.width(), mask.height());
  std::vector<std::pair<int, int>> next;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= mask.width() || y >= mask.height()) return;
    if (!mask.at(x, y) || reached.at(x, y)) return;
    reached.set(x, y);
    next.emplace_back(x, y);
  };
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (x == 0 || y == 0 || x == mask.width() - 1 || y == mask.height() - 1) visit(x, y);
  while (!next.empty()) {
    const auto [x, y] = next.back();
    next.pop_back();
    visit(x - 1, y);
    visit(x + 1, y);
    visit(x, y - 1);
    visit(x, y + 1);
  }
  return reached;
}

void expect_equal(const BitPlane& a, const BitPlane& b) {
  ASSERT_EQ(a.words().size(), b.words().size());
  for (std::size_t i = 0; i < a.words().size(); ++i) ASSERT_EQ(a.words()[i], b.words()[i]);
}

TEST(BitPlane, AHoleInARingIsNotReached) {
  const BitPlane ring = drawn({"........",  //
                               ".#####..",  //
                               ".#...#..",  //
                               ".#.#.#..",  //
                               ".#####..",  //
                               "........"});
  EXPECT_EQ(flooded(ring).count(), 0);  // it does not touch the border
  BitPlane ground = ring;
  for (auto& word : ground.words()) word = ~word & ground.inside(0);
  const BitPlane outside = flooded(ground);
  EXPECT_TRUE(outside.at(0, 0));
  EXPECT_TRUE(outside.at(7, 3));
  EXPECT_FALSE(outside.at(2, 2));
  EXPECT_FALSE(outside.at(4, 3));
}

TEST(BitPlane, DiagonalNeighboursAreNotConnected) {
  EXPECT_EQ(flooded(drawn({"#....", ".#...", "..#..", "...##"})).count(), 3);
}

TEST(BitPlane, ASpiralIsFollowedToItsEnd) {
  const BitPlane spiral = drawn({"#########",  //
                                 "........#",  //
                                 ".######.#",  //
                                 ".#....#.#",  //
                                 ".#.##.#.#",  //
                                 ".#.#..#.#",  //
                                 ".#.####.#",  //
                                 ".#......#",  //
                                 ".########"});
  EXPECT_EQ(flooded(spiral).count(), spiral.count());
}

TEST(BitPlane, EmptyAndFullAndOneSample) {
  EXPECT_EQ(flooded(BitPlane(80, 60)).count(), 0);
  BitPlane full(80, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) full.set(x, y);
  EXPECT_EQ(full.count(), 4800);
  EXPECT_EQ(flooded(full).count(), 4800);
  EXPECT_EQ(flooded(drawn({"#"})).count(), 1);
}

// Widths around a word's, 32 and 64 bits.
constexpr std::array widths{1, 2, 20, 31, 32, 33, 63, 64, 65, 80, 127, 128, 129, 320};

TEST(BitPlane, FloodsLikeAFloodBySamples) {
  std::mt19937_64 random(11);
  for (const int width : widths) {
    for (int round = 0; round < 40; ++round) {
      BitPlane mask(width, 1 + static_cast<int>(random() % 40));
      const std::uint64_t density = 40 + random() % 50;  // of 100: around the percolation threshold
      for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < width; ++x)
          if (random() % 100 < density) mask.set(x, y);
      expect_equal(flooded(mask), flooded_by_samples(mask));
    }
  }
}

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
