#include "drivers/sim/light.hpp"

#include <cstdint>
#include <gtest/gtest.h>

namespace gazed::sim::light_test {
namespace {

TEST(Light, IsRoundedAndHeld) {
  EXPECT_EQ(levels_of(light_of(100.0)), 100.0F);
  EXPECT_EQ(light_of(1.0 / 64.0 + 1e-9), 1);
  EXPECT_EQ(light_of(1e9), INT16_MAX);
  EXPECT_EQ(light_of(-1e9), INT16_MIN);
  EXPECT_EQ(rounded_light(std::int64_t{7} << 10 | 512, 10), 8);
  EXPECT_EQ(rounded_light(std::int64_t{1} << 40, 3), INT16_MAX);
  EXPECT_EQ(rounded_light(-17, 0), -17);
}

}  // namespace
}  // namespace gazed::sim::light_test
