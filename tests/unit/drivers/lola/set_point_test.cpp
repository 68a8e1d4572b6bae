#include "drivers/lola/set_point.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "agent/geometry/limits.hpp"
#include "drivers/lola/body.hpp"

namespace gazed::lola::set_point_test {
namespace {

// HeadYaw's greatest speed (the NAO's URDF), for a cycle of 12 ms.
constexpr double greatest_yaw_step_rad = 8.26797 * 0.012;
constexpr double float_rad = 2e-6;  // what it stays inside of limits and speeds

TEST(SetPoint, StartsWhereTheHeadIs) {
  SetPoint set_point;
  set_point.start({0.3, -0.1});
  EXPECT_EQ(set_point.angles(), (geometry::HeadAngles{0.3, -0.1}));
}

TEST(SetPoint, StartsInsideTheLimits) {
  SetPoint set_point;
  set_point.start({3.0, -3.0});
  EXPECT_TRUE(geometry::HeadLimits().contains(set_point.angles()));
}

TEST(SetPoint, GathersSpeedAndBrakesAndArrivesTogether) {
  // 20 rad/s^2 (B-Human 2024) in yaw, up to 0.3 of 8.26797 rad/s; for the last step 5.8 mrad more.
  constexpr double cycle_s = 0.012, greatest_change_rad = 20.0 * cycle_s * cycle_s + 0.006;
  constexpr double speed_rad_s = 0.3 * 8.26797;
  SetPoint set_point;
  double last_step_rad = 0.0, greatest_step_rad = 0.0;
  int steps = 0;
  for (bool there = false; !there; ++steps) {
    const geometry::HeadAngles before = set_point.angles();
    there = set_point.step({0.8, 0.16}, 0.3, lola_cycle_us);
    EXPECT_NEAR(set_point.angles().pitch_rad, 0.2 * set_point.angles().yaw_rad, 1e-9);
    const double step_rad = set_point.angles().yaw_rad - before.yaw_rad;
    EXPECT_GE(step_rad, 0.0);
    EXPECT_LT(std::abs(step_rad - last_step_rad), greatest_change_rad) << steps;
    greatest_step_rad = std::max(greatest_step_rad, step_rad);
    last_step_rad = step_rad;
  }
  EXPECT_EQ(set_point.angles(), (geometry::HeadAngles{0.8, 0.16}));
  EXPECT_NEAR(greatest_step_rad, speed_rad_s * cycle_s, 1e-5);
  // The way at the greatest speed, and half of what it takes to reach it and to brake from it.
  EXPECT_NEAR(steps * cycle_s, 0.8 / speed_rad_s + speed_rad_s / 20.0, 3.0 * cycle_s);
}

// Any target at any time, in the middle where the table of limits does not bend the way.
TEST(SetPoint, BrakesBeforeItTurns) {
  // 20 rad/s^2 for one cycle; a turn may cost that once more, and braking at a way's end two.
  constexpr double change_rad = 20.0 * 0.012 * 0.012;
  std::mt19937_64 random(1);
  const auto uniform = [&](double min, double max) {
    return min + (max - min) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  SetPoint set_point;
  geometry::HeadAngles target, last_step;
  double speed_fraction = 1.0;
  for (int i = 0; i < 100'000; ++i) {
    if (random() % 20 == 0) {
      target = {uniform(-0.3, 0.3), uniform(-0.2, 0.2)};
      speed_fraction = uniform(0.01, 1.0);
    }
    const geometry::HeadAngles before = set_point.angles();
    set_point.step(target, speed_fraction, lola_cycle_us);
    const geometry::HeadAngles step = set_point.angles() - before;
    ASSERT_LE(geometry::greatest_difference(step, last_step), 3.0 * change_rad + float_rad) << i;
    last_step = step;
  }
}

TEST(SetPoint, ArrivesAfterATurn) {
  SetPoint set_point;
  for (int i = 0; i < 20; ++i) set_point.step({1.0, 0.0}, 1.0, lola_cycle_us);
  int steps = 0;
  while (!set_point.step({-1.0, 0.1}, 1.0, lola_cycle_us)) ASSERT_LT(++steps, 100);
  EXPECT_EQ(set_point.angles(), (geometry::HeadAngles{-1.0, 0.1}));
  EXPECT_TRUE(set_point.step({-1.0, 0.1}, 1.0, lola_cycle_us)) << "and stays";
}

TEST(SetPoint, ALateStepIsNoLongerOne) {
  SetPoint late, punctual;
  for (int i = 0; i < 30; ++i) {
    EXPECT_FALSE(late.step({2.0, 0.0}, 0.3, 10 * lola_cycle_us));
    EXPECT_FALSE(punctual.step({2.0, 0.0}, 0.3, lola_cycle_us));
  }
  EXPECT_EQ(late.angles(), punctual.angles());
}

TEST(SetPoint, AnEarlyStepIsAShorterOne) {
  SetPoint set_point;
  set_point.follow({2.0, 0.0}, lola_cycle_us / 4);
  EXPECT_NEAR(set_point.angles().yaw_rad, 0.25 * greatest_yaw_step_rad, float_rad);
  const geometry::HeadAngles there = set_point.angles();
  EXPECT_FALSE(set_point.step({2.0, 0.0}, 1.0, 0));
  EXPECT_FALSE(set_point.step({2.0, 0.0}, 1.0, -5));
  EXPECT_EQ(set_point.angles(), there);
}

TEST(SetPoint, FollowsAHandNoFasterThanTheMotors) {
  SetPoint set_point;
  set_point.follow({0.5, 0.4}, lola_cycle_us);
  EXPECT_LE(set_point.angles().yaw_rad, greatest_yaw_step_rad);
  EXPECT_NEAR(set_point.angles().pitch_rad, 0.8 * set_point.angles().yaw_rad, 1e-9);
  set_point.follow({0.05, 0.05}, lola_cycle_us);
  EXPECT_EQ(set_point.angles(), (geometry::HeadAngles{0.05, 0.05}));
}

// The straight way from one side to the other at the lowest pitch is barred by the shoulders.
TEST(SetPoint, GoesAlongTheEdgeOfTheLimits) {
  SetPoint set_point;
  const geometry::HeadLimits limits;
  const geometry::HeadAngles from{-2.0, limits.pitch_range(-2.0).min_rad + 0.01};
  const geometry::HeadAngles to{2.0, limits.pitch_range(2.0).min_rad + 0.01};
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
  EXPECT_LT(
      geometry::greatest_difference(set_point.angles(), geometry::HeadLimits().clamp({9.0, 9.0})),
      float_rad);
}

}  // namespace
}  // namespace gazed::lola::set_point_test
