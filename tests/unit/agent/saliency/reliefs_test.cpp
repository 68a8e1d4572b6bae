// Heights and the border's reach, against the same sample by sample.
#include "agent/saliency/reliefs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/unit/agent/saliency/grid.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::saliency::reliefs_test {
namespace {

struct Samples : Grid<std::int16_t> {
  using Grid::Grid;
};

/// A height for each character: '0' is 0, '9' nine intervals.
Samples drawn(const std::vector<std::string_view>& rows) {
  Samples samples(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x)
      samples.at(static_cast<int>(x), static_cast<int>(y)) =
          static_cast<std::int16_t>(100 * (rows[y][x] - '0'));
  return samples;
}

/// In intervals, of the first relief.
double reach_at(Samples samples, int width, int height, int x, int y, int lane = 0) {
  Reliefs reliefs(width, height);
  reliefs.add(samples.plane(), 0, 900, 9);
  Reach reach(width, height);
  reach.find(reliefs);
  return static_cast<double>(std::as_const(reach).row(y)[x * lane_count + lane]) / interval_heights;
}

constexpr double rounding = 1.0 / interval_heights;

TEST(Reliefs, HeightsAreIntervalsUprightAndUpsideDown) {
  Samples first(20, 15), second(20, 15);
  first.at(3, 4) = -500;
  second.at(3, 4) = 32766;
  Reliefs reliefs(20, 15);
  reliefs.add(first.plane(), -500, 1500, 10);
  reliefs.add(second.plane(), 0, 32766, 5);
  const std::int16_t* at = reliefs.row(4) + std::ptrdiff_t{3} * lane_count;
  EXPECT_EQ(at[0], 0);
  EXPECT_EQ(at[1], 5 * interval_heights);
  EXPECT_EQ(at[4], 10 * interval_heights);
  EXPECT_EQ(at[5], 0);
  at = reliefs.row(4) + std::ptrdiff_t{19} * lane_count;
  EXPECT_NEAR(at[0], 2.5 * interval_heights, 1);
  EXPECT_EQ(at[0] + at[4], 10 * interval_heights);
  for (const int none : {2, 3, 6, 7}) EXPECT_EQ(at[none], 0);
}

TEST(Reliefs, AreForgotten) {
  Samples samples(20, 15);
  Reliefs reliefs(20, 15);
  reliefs.add(samples.plane(), -10, 10, 3);
  reliefs.clear();
  EXPECT_EQ(reliefs.count(), 0);
  const std::int16_t* row = reliefs.row(2);
  EXPECT_TRUE(std::all_of(row, row + 20 * lane_count, [](std::int16_t h) { return h == 0; }));
}

TEST(Reach, AHillIsReachedUpToItsFoot) {
  const Samples hill = drawn({"22222", "23332", "23832", "23332", "22222"});
  EXPECT_NEAR(reach_at(hill, 5, 5, 2, 2), 2.0, rounding);
  EXPECT_NEAR(reach_at(hill, 5, 5, 0, 2), 2.0, rounding);
}

TEST(Reach, AHollowIsOneUpsideDown) {
  const Samples ring = drawn({"11111", "16661", "16061", "16661", "11111"});
  EXPECT_NEAR(reach_at(ring, 5, 5, 2, 2), 0.0, rounding);           // upright: its own height
  EXPECT_NEAR(reach_at(ring, 5, 5, 2, 2, 4), 9.0 - 6.0, rounding);  // down to 6, up to 0
}

TEST(Reach, AWayThroughAPassCountsItsLowestHeight) {
  const Samples gap = drawn({"1111111", "1777771", "1799751", "1777771", "1111111"});
  EXPECT_NEAR(reach_at(gap, 7, 5, 3, 2), 1.0, rounding);
  const Samples open = drawn({"1111111", "1777771", "1799755", "1777771", "1111111"});
  EXPECT_NEAR(reach_at(open, 7, 5, 3, 2), 5.0, rounding);
}

TEST(Reach, DiagonalNeighboursAreNoWay) {
  EXPECT_NEAR(reach_at(drawn({"90000", "09000", "00900", "00090", "00009"}), 5, 5, 2, 2), 0.0,
              rounding);
}

TEST(Reach, ASpiralIsFollowedToItsEnd) {
  const Samples spiral = drawn({"000000000",  //
                                "099999990",  //
                                "090000090",  //
                                "090999090",  //
                                "090909090",  //
                                "090900090",  //
                                "090999990",  //
                                "090000000",  //
                                "090000000"});
  EXPECT_NEAR(reach_at(spiral, 9, 9, 5, 4), 9.0, rounding);
}

/// Every sample at every height, from the border inwards, until nothing is new.
std::vector<std::int16_t> flooded(const std::vector<std::int16_t>& heights, int width, int height) {
  std::vector<std::int16_t> reach(heights.size());
  std::vector<int> next;
  const auto visit = [&](int i, std::int16_t from) {
    const std::int16_t reached = std::min(heights[static_cast<std::size_t>(i)], from);
    if (reached <= reach[static_cast<std::size_t>(i)]) return;
    reach[static_cast<std::size_t>(i)] = reached;
    next.push_back(i);
  };
  for (int i = 0; i < width * height; ++i) {
    const int x = i % width, y = i / width;
    if (x == 0 || y == 0 || x == width - 1 || y == height - 1)
      visit(i, std::numeric_limits<std::int16_t>::max());
  }
  while (!next.empty()) {
    const int i = next.back(), x = i % width, y = i / width;
    next.pop_back();
    const std::int16_t from = reach[static_cast<std::size_t>(i)];
    if (x > 0) visit(i - 1, from);
    if (x < width - 1) visit(i + 1, from);
    if (y > 0) visit(i - width, from);
    if (y < height - 1) visit(i + width, from);
  }
  return reach;
}

TEST(Reach, IsThatOfAFloodBySamples) {
  std::mt19937_64 random(17);
  for (const auto& [width, height] : {std::pair{20, 15}, {33, 16}, {80, 60}}) {
    for (int round = 0; round < test::trials(10, 2); ++round) {
      std::array<Samples, 2> planes{Samples(width, height), Samples(width, height)};
      Reliefs reliefs(width, height);
      for (Samples& plane : planes) {
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x)
            plane.at(x, y) = static_cast<std::int16_t>(random() % 901);
        reliefs.add(plane.plane(), 0, 900, 9);
      }
      Reach reach(width, height);
      reach.find(reliefs);
      for (const int lane : {0, 1, 4, 5}) {
        std::vector<std::int16_t> heights;
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) heights.push_back(reliefs.row(y)[x * lane_count + lane]);
        const std::vector<std::int16_t> expected = flooded(heights, width, height);
        for (int i = 0; i < width * height; ++i)
          ASSERT_EQ(std::as_const(reach).row(i / width)[i % width * lane_count + lane],
                    expected[static_cast<std::size_t>(i)])
              << i % width << ',' << i / width;
      }
    }
  }
}

}  // namespace
}  // namespace gazed::saliency::reliefs_test
