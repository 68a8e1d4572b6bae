#include "agent/tracking/slopes.hpp"

#include <gtest/gtest.h>

#include "agent/geometry/pose.hpp"

namespace gazed::tracking::slopes_test {
namespace {

constexpr double inverse_depth_per_m = 3.0;

PatchWarp sloping(double slope_per_m) {
  PatchWarp warp;
  warp.inverse_depth_per_m = inverse_depth_per_m;
  warp.slope_per_m = {slope_per_m, 0.0};
  return warp;
}

/// To the side, by that much.
PatchMotion motion(double baseline_m) {
  PatchMotion out;
  out.cam2_from_cam1.translation = {baseline_m, 0.0, 0.0};
  return out;
}

TEST(BelievedSlopes, ASurfaceOfAnyTiltHasTheSameInEveryLook) {
  for (const double slope_per_m : {0.0, 1.5, -3.0}) {
    BelievedSlopes slopes;
    for (const double baseline_m : {0.01, 0.05, 0.03})
      EXPECT_TRUE(slopes.believe(sloping(slope_per_m + 0.2), motion(baseline_m))) << slope_per_m;
  }
}

// A cover leaves a third of the object out.
TEST(BelievedSlopes, WhatIsSqueezedAgainstTheLooksBeforeIsNotBelieved) {
  BelievedSlopes slopes;
  EXPECT_TRUE(slopes.believe(sloping(0.3), motion(0.01)));
  EXPECT_FALSE(slopes.believe(sloping(0.3 + 0.33 / 0.05), motion(0.05)));
  EXPECT_TRUE(slopes.believe(sloping(0.4), motion(0.05)));
}

// A table top is steep in all looks, what is covered in some.
TEST(BelievedSlopes, OfTheFirstLookSteepOnesAreBelievedWhenSeenTwice) {
  constexpr double steep_per_m = 3.0 * inverse_depth_per_m;
  BelievedSlopes table;
  EXPECT_FALSE(table.believe(sloping(steep_per_m), motion(0.01)));
  EXPECT_TRUE(table.believe(sloping(steep_per_m), motion(0.04)));
  BelievedSlopes covered;
  EXPECT_FALSE(covered.believe(sloping(steep_per_m), motion(0.03)));
  EXPECT_TRUE(covered.believe(sloping(0.1), motion(0.03)));
  EXPECT_FALSE(covered.believe(sloping(steep_per_m), motion(0.03)));
}

TEST(BelievedSlopes, AnotherTargetBeginsAnew) {
  BelievedSlopes slopes;
  EXPECT_TRUE(slopes.believe(sloping(0.0), motion(0.05)));
  EXPECT_FALSE(slopes.believe(sloping(3.0), motion(0.05)));
  slopes.clear();
  EXPECT_TRUE(slopes.believe(sloping(3.0), motion(0.05)));
}

}  // namespace
}  // namespace gazed::tracking::slopes_test
