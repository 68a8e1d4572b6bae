#include "agent/tracking/corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "scene.hpp"

namespace gazed::tracking::corners_test {
namespace {

constexpr int width = 320, height = 240;

template <typename Grey>
LumaLevel painted(Grey grey) {
  LumaLevel level;
  level.resize(width, height, 2);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value = std::clamp<double>(grey(x, y), 0.0, 255.0);
      level.row(y)[x] = static_cast<std::uint16_t>(std::lround(luma_one * value));
    }
  }
  return level;
}

std::vector<Corner> picked(const LumaLevel& level, std::size_t most = 100) {
  CornerPicker picker(width, height);
  std::vector<Corner> corners(most);
  corners.resize(picker.pick(level, corners, [](int, int) { return true; }));
  return corners;
}

LumaLevel textured() {
  return painted([](int x, int y) { return 60 + 120 * value_noise(x, y, 7.0, 3); });
}

// The measure once more, the slow way.
double strength_of(const LumaLevel& level, int column, int row) {
  constexpr int half = CornerPicker::window / 2;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (int y = row - half; y <= row + half; ++y) {
    for (int x = column - half; x <= column + half; ++x) {
      const double unit = 2.0 * static_cast<double>(luma_one);
      const double gx = (level.row(y)[x + 1] - level.row(y)[x - 1]) / unit;
      const double gy = (level.row(y + 1)[x] - level.row(y - 1)[x]) / unit;
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  return (xx * yy - xy * xy) / (xx + yy);
}

TEST(Corners, BlankGivesNone) {
  EXPECT_TRUE(picked(painted([](int, int) { return 180.0; })).empty());
}

TEST(Corners, EdgesAndRampsGiveNone) {
  EXPECT_TRUE(picked(painted([](int x, int) { return x < 150 ? 40.0 : 200.0; })).empty());
  EXPECT_TRUE(picked(painted([](int x, int y) { return 10.0 + 0.4 * x + 0.3 * y; })).empty());
}

TEST(Corners, ASquareHasFour) {
  const auto corners = picked(painted(
      [](int x, int y) { return x >= 100 && x < 140 && y >= 80 && y < 130 ? 60.0 : 180.0; }));
  ASSERT_EQ(corners.size(), 4U);
  for (const Corner& corner : corners) {
    // The window is best placed with the corner well inside.
    EXPECT_LE(std::min(std::abs(corner.column - 100), std::abs(corner.column - 140)), 3);
    EXPECT_LE(std::min(std::abs(corner.row - 80), std::abs(corner.row - 130)), 3);
  }
}

TEST(Corners, StrengthIsThatOfTheGradientMatrix) {
  constexpr double relative_tolerance = 0.06;  // gradients are cut to quarter grey levels
  const LumaLevel level = textured();
  for (const Corner& corner : picked(level)) {
    const double expected = strength_of(level, corner.column, corner.row);
    EXPECT_NEAR(static_cast<double>(corner.strength), expected, relative_tolerance * expected);
  }
}

TEST(Corners, SpreadOverTheFrame) {
  const auto corners = picked(textured());
  EXPECT_EQ(corners.size(), 100U);
  std::set<std::pair<int, int>> cells;
  for (const Corner& corner : corners) cells.insert({corner.column / 32, corner.row / 24});
  EXPECT_GT(cells.size(), 80U);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_GE(std::min({corners[i].column, corners[i].row, width - 1 - corners[i].column,
                        height - 1 - corners[i].row}),
              CornerPicker::border);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(std::max(std::abs(corners[i].column - corners[j].column),
                         std::abs(corners[i].row - corners[j].row)),
                CornerPicker::distance_min);
    }
  }
}

// Where only a part of the frame has texture, it gets several corners a cell.
TEST(Corners, FillsUpWhereThereIsTexture) {
  const auto corners = picked(
      painted([](int x, int y) { return x < 160 ? 60 + 120 * value_noise(x, y, 4.0, 3) : 120.0; }));
  EXPECT_GT(corners.size(), 90U);
}

TEST(Corners, TakesOnlyWhatIsAllowed) {
  const LumaLevel level = textured();
  CornerPicker picker(width, height);
  std::array<Corner, 100> corners;
  const std::size_t count =
      picker.pick(level, corners, [](int column, int) { return column > 200; });
  EXPECT_GT(count, 20U);
  for (std::size_t i = 0; i < count; ++i) EXPECT_GT(corners[i].column, 200);
}

TEST(Corners, NoMoreThanAskedFor) {
  EXPECT_EQ(picked(textured(), 7).size(), 7U);
  EXPECT_EQ(picked(textured(), 0).size(), 0U);
}

}  // namespace
}  // namespace gazed::tracking::corners_test
