#include "agent/saliency/winner.hpp"

#include <cstdint>
#include <gtest/gtest.h>

#include "tests/unit/agent/saliency/grid.hpp"

namespace gazed::saliency::winner_test {
namespace {

struct Map : Grid<std::int32_t> {
  using Grid::Grid;
  [[nodiscard]] Winner winner() { return find_winner(plane()); }
};

TEST(Winner, ASampleIsCentredOnSixteenTimesItsIndex) {
  Map map(40, 30);
  map.at(11, 7) = 1 << 24;
  EXPECT_EQ(map.winner().pixel, geometry::Pixel(176, 112));
}

// Samples of 1000 - 100 (x - 10.3)^2, 1000 - 200 (y - 4.8)^2: a parabola is met exactly.
TEST(Winner, AParabolasTopIsMet) {
  Map map(20, 10);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      map.at(x, y) =
          2000000 - 100 * (10 * x - 103) * (10 * x - 103) - 200 * (10 * y - 48) * (10 * y - 48);
  const Winner winner = map.winner();
  EXPECT_EQ(winner.x, 10);
  EXPECT_EQ(winner.y, 5);
  EXPECT_NEAR(winner.pixel.x(), 16 * 10.3, 1e-9);
  EXPECT_NEAR(winner.pixel.y(), 16 * 4.8, 1e-9);
}

TEST(Winner, OfEqualSamplesTheFirstInRasterOrderWins) {
  Map map(20, 10);
  map.at(15, 2) = map.at(3, 6) = 500;
  EXPECT_EQ(map.winner().x, 15);
  EXPECT_EQ(map.winner().y, 2);
}

TEST(Winner, BetweenTwoEqualNeighboursIsHalfway) {
  Map map(20, 10);
  map.at(7, 4) = map.at(8, 4) = 500;
  EXPECT_EQ(map.winner().pixel, geometry::Pixel(7.5 * 16, 4 * 16));
}

TEST(Winner, OnTheBorderIsNotMovedAcrossIt) {
  Map map(20, 10);
  map.at(0, 9) = 500;
  map.at(1, 9) = 400;
  EXPECT_EQ(map.winner().pixel, geometry::Pixel(0, 9 * 16));
}

TEST(Winner, AFlatMapGivesTheFirstSample) {
  EXPECT_EQ(Map(20, 10).winner().pixel, geometry::Pixel(0, 0));
  EXPECT_EQ(Map(1, 1).winner().pixel, geometry::Pixel(0, 0));
}

}  // namespace
}  // namespace gazed::saliency::winner_test
