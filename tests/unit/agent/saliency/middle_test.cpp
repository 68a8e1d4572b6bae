// From a detail to the middle of its object.
#include "agent/saliency/middle.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <utility>

#include "agent/saliency/saliency.hpp"
#include "agent/saliency/winner.hpp"

#include "tests/unit/agent/saliency/grid.hpp"

namespace gazed::saliency::middle_test {
namespace {

constexpr int width = 20, height = 15;
constexpr std::int32_t peak = 255 << 16;

geometry::Pixel middle_of(Grid<std::int32_t>& map) {
  Grid<std::int32_t> smooth(width, height), scratch(width, height);
  return middle_of_object(map.plane(), find_winner(map.plane()), smooth.plane(), scratch.plane());
}

TEST(Middle, OfALoneSampleIsItself) {
  Grid<std::int32_t> map(width, height);
  map.at(7, 5) = peak;
  EXPECT_EQ(middle_of(map), geometry::Pixel(7 * saliency_cell_px, 5 * saliency_cell_px));
}

TEST(Middle, OfAThingWithADetailAtItsEdgeIsInside) {
  Grid<std::int32_t> map(width, height);
  for (int y = 5; y <= 9; ++y)
    for (int x = 6; x <= 10; ++x) map.at(x, y) = peak / 2;
  map.at(6, 5) = peak;
  const geometry::Pixel middle = middle_of(map) / saliency_cell_px;
  EXPECT_GT(middle.x(), 6.5);
  EXPECT_LT(middle.x(), 8.5);
  EXPECT_GT(middle.y(), 5.5);
  EXPECT_LT(middle.y(), 7.5);
}

// Blurred with a reflected border, the outermost samples would be the higher ones.
TEST(Middle, TheBorderDrawsNoSummitOut) {
  for (const auto& [x, y] : {std::pair{1, 7}, {width - 2, 7}, {9, 1}, {9, height - 2}, {1, 1}}) {
    Grid<std::int32_t> map(width, height);
    map.at(x, y) = peak;
    EXPECT_LE((middle_of(map) / saliency_cell_px - geometry::Pixel(x, y)).cwiseAbs().maxCoeff(),
              0.5)
        << x << " " << y;
  }
}

TEST(Middle, FromTheBorderTheWayGoesInside) {
  Grid<std::int32_t> map(width, height);
  map.at(0, 7) = peak;
  EXPECT_GE(middle_of(map).x(), 0.5 * saliency_cell_px);
}

TEST(Middle, OfNothingIsSomewhereInTheFrame) {
  Grid<std::int32_t> map(width, height);
  EXPECT_EQ(middle_of(map), geometry::Pixel(0, 0));
}

}  // namespace
}  // namespace gazed::saliency::middle_test
