#include "drivers/lola/set_point.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body.hpp"

namespace gazed::set_point_test {
namespace {

constexpr double float_rad = 2e-6;  // what it stays inside of limits and speeds

TEST(SetPoint, StartsWhereTheHeadIs) {
  SetPoint set_point;
  set_point.start({0.3, -0.1});
  EXPECT_EQ(set_point.angles(), (HeadAngles{0.3, -0.1}));
}

TEST(SetPoint, StartsInsideTheLimits) {
  SetPoint set_point;
  set_point.start({3.0, -3.0});
  EXPECT_TRUE(HeadLimits().contains(set_point.angles()));
}

TEST(SetPoint, MovesAtTheSpeedAskedForAndArrivesTogether) {
  SetPoint set_point;
  int steps = 1;
  while (!set_point.step({0.5, 0.1}, 0.3, lola_cycle_us)) {
    EXPECT_NEAR(set_point.angles().pitch_rad, 0.2 * set_point.angles().yaw_rad, 1e-9);
    ++steps;
  }
  EXPECT_EQ(steps, static_cast<int>(std::ceil(0.5 / (0.3 * greatest_step().yaw_rad))));
  EXPECT_EQ(set_point.angles(), (HeadAngles{0.5, 0.1}));
}

TEST(SetPoint, ALateStepIsNoLongerOne) {
  SetPoint late, punctual;
  EXPECT_FALSE(late.step({2.0, 0.0}, 1.0, 10 * lola_cycle_us));
  EXPECT_FALSE(punctual.step({2.0, 0.0}, 1.0, lola_cycle_us));
  EXPECT_EQ(late.angles(), punctual.angles());
}

TEST(SetPoint, AnEarlyStepIsAShorterOne) {
  SetPoint set_point;
  set_point.step({2.0, 0.0}, 1.0, lola_cycle_us / 4);
  EXPECT_NEAR(set_point.angles().yaw_rad, 0.25 * greatest_step().yaw_rad, float_rad);
  const HeadAngles there = set_point.angles();
  EXPECT_FALSE(set_point.step({2.0, 0.0}, 1.0, 0));
  EXPECT_FALSE(set_point.step({2.0, 0.0}, 1.0, -5));
  EXPECT_EQ(set_point.angles(), there);
}

// The straight way from one side to the other at the lowest pitch is barred by the shoulders.
TEST(SetPoint, GoesAlongTheEdgeOfTheLimits) {
  SetPoint set_point;
  const HeadLimits limits;
  const HeadAngles from{-2.0, limits.pitch_range(-2.0).min_rad + 0.01};
  const HeadAngles to{2.0, limits.pitch_range(2.0).min_rad + 0.01};
  ASSERT_FALSE(limits.contains_segment(from, to));
  set_point.start(from);
  int steps = 0;
  while (!set_point.step(to, 0.5, lola_cycle_us)) {
    ASSERT_TRUE(limits.contains(set_point.angles()));
    ASSERT_LT(++steps, 200);
  }
  EXPECT_EQ(set_point.angles(), to);
}

TEST(SetPoint, ATargetOutsideIsReachedAtTheNearestAllowedPlace) {
  SetPoint set_point;
  int steps = 0;
  while (!set_point.step({9.0, 9.0}, 1.0, lola_cycle_us)) ASSERT_LT(++steps, 100);
  EXPECT_LT(greatest_difference(set_point.angles(), HeadLimits().clamp({9.0, 9.0})), float_rad);
}

}  // namespace
}  // namespace gazed::set_point_test
