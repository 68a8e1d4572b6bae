#include "drivers/sim/mipmap.hpp"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

#include "picture.hpp"

namespace gazed::mipmap_test {
namespace {

using testing::look_up, testing::ramp;

TEST(MipMap, ARampIsTheSameRampOnEveryLevel) {
  constexpr float tolerance = 0.02F;  // samples are rounded to 1/64 on each level
  const auto map = ramp(64, 16);
  for (const float footprint : {0.0F, 1.0F, 1.5F, 2.0F, 4.0F}) {
    for (float x = 8.0F; x < 56.0F; x += 0.37F) {
      const std::array<float, 3> rgb = look_up(*map, static_cast<double>(x), 8.0, footprint);
      EXPECT_NEAR(rgb[0], x - 0.5F, tolerance) << footprint << " " << x;
      EXPECT_EQ(rgb[0], rgb[2]);
    }
  }
}

TEST(MipMap, OddSizesAndSinglePixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {1, 7}, {5, 3}}) {
    const auto map = ramp(width, height);
    for (const float footprint : {0.0F, 1e9F, std::numeric_limits<float>::quiet_NaN()})
      EXPECT_GE(look_up(*map, -100.0, 1e6, footprint)[0], 0.0F);
    EXPECT_EQ(look_up(*map, 0.5, 0.5, 0.0F)[0], 0.0F);
  }
}

}  // namespace
}  // namespace gazed::mipmap_test
