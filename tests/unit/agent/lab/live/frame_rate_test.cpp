#include "agent/lab/live/frame_rate.hpp"

#include <gtest/gtest.h>

namespace gazed::lab::live::frame_rate_test {
namespace {

constexpr double rounding = 1e-9;

TEST(FrameRate, NeedsTwoFrames) {
  FrameRate rate;
  EXPECT_EQ(rate.per_second(), 0.0);
  rate.saw(1.0);
  EXPECT_EQ(rate.per_second(), 0.0);
  rate.saw(1.04);
  EXPECT_NEAR(rate.per_second(), 25.0, rounding);
}

TEST(FrameRate, IsThatOfTheNewestThirty) {
  FrameRate rate;
  double now_s = 0.0;
  for (int i = 0; i < 50; ++i) rate.saw(now_s += 0.1);
  for (int i = 0; i < 30; ++i) rate.saw(now_s += 0.02);
  EXPECT_NEAR(rate.per_second(), 50.0, rounding);
}

TEST(FrameRate, FramesOfOneMomentHaveNone) {
  FrameRate rate;
  rate.saw(3.0);
  rate.saw(3.0);
  EXPECT_EQ(rate.per_second(), 0.0);
}

}  // namespace
}  // namespace gazed::lab::live::frame_rate_test
