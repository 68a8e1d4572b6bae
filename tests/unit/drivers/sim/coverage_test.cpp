#include "drivers/sim/coverage.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace gazed::sim::coverage_test {
namespace {

TEST(Coverage, IsTheAreaOfThePixelInsideTheEdge) {
  constexpr int n = 400;                 // sub-samples a side
  constexpr double tolerance = 2.0 / n;  // each row of them is off by at most one at either end
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 24.0 + 0.01;
    const double nx = std::cos(angle), ny = std::sin(angle);
    for (double distance = -0.8; distance <= 0.8; distance += 0.1) {
      int inside = 0;
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const double px = (x + 0.5) / n - 0.5, py = (y + 0.5) / n - 0.5;
          if (px * nx + py * ny <= distance) ++inside;
        }
      EXPECT_NEAR(half_plane_coverage(distance, nx, ny), inside / double{n * n}, tolerance)
          << angle << " " << distance;
    }
  }
}

TEST(Coverage, EdgeAlongTheRowsOrColumns) {
  EXPECT_DOUBLE_EQ(half_plane_coverage(0.0, 1.0, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(half_plane_coverage(0.25, 0.0, -1.0), 0.75);
  EXPECT_DOUBLE_EQ(half_plane_coverage(0.5, 1.0, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(half_plane_coverage(-0.5, 1.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(half_plane_coverage(-7.0, 1.0, 0.0), 0.0);
}

}  // namespace
}  // namespace gazed::sim::coverage_test
