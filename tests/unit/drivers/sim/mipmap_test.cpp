#include "drivers/sim/mipmap.hpp"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

#include "drivers/sim/texture.hpp"

#include "picture.hpp"

namespace gazed::sim::mipmap_test {
namespace {

using testing::look_up, testing::ramp;

TEST(MipMap, ARampIsTheSameRampOnEveryLevel) {
  constexpr float tolerance = 0.02F;  // samples are rounded to 1/64 on each level
  const auto map = testing::ramp(64, 16);
  for (const float footprint : {0.0F, 1.0F, 1.5F, 2.0F, 4.0F}) {
    for (float x = 8.0F; x < 56.0F; x += 0.37F) {
      const std::array<float, 3> rgb =
          testing::look_up(*map, static_cast<double>(x), 8.0, footprint);
      EXPECT_NEAR(rgb[0], x - 0.5F, tolerance) << footprint << " " << x;
      EXPECT_EQ(rgb[0], rgb[2]);
    }
  }
}

TEST(MipMap, OddSizesAndSinglePixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {1, 7}, {5, 3}}) {
    const auto map = testing::ramp(width, height);
    EXPECT_EQ(testing::look_up(*map, -100.0, 3e4, 0.0F)[0], 0.0F);
    EXPECT_EQ(testing::look_up(*map, 3e4, -3e4, 0.0F)[0], static_cast<float>(width - 1));
    for (const float footprint :
         {1e9F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
      EXPECT_LE(testing::look_up(*map, 0.0, 0.0, footprint)[0], static_cast<float>(width - 1));
    EXPECT_EQ(testing::look_up(*map, 0.5, 0.5, 0.0F)[0], 0.0F);
  }
}

TEST(MipMap, ATileRepeats) {
  const auto tile = make_noise_tile(Pattern::natural, 4);
  const double side = tile->width();
  for (const double x : {0.0, 0.3, 17.75, 255.5, 511.9})
    for (const float footprint : {0.0F, 1.7F, 30.0F}) {
      const float value = testing::look_up(*tile, x, 100.0, footprint)[0];
      // Beside 2^15 and 2^16 samples, where the places' numbers wrap.
      for (const double tiles : {-129.0, -128.0, -64.0, -1.0, 1.0, 63.0, 64.0, 127.0, 128.0})
        EXPECT_EQ(testing::look_up(*tile, x + side * tiles, 100.0 - side * tiles, footprint)[0],
                  value)
            << x << ", " << tiles << " tiles away";
    }
}

}  // namespace
}  // namespace gazed::sim::mipmap_test
