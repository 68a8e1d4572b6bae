#include "agent/gaze/planner.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "agent/gaze/step_rule.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::gaze::planner_test {
namespace {

constexpr double rounding_rad = 1e-12;

PlannedHead nao_v6() {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  rig.uncertainty.pixel_sigma_px = 0.5;
  rig.uncertainty.encoder_sigma_rad = 0.0015;
  return {rig, geometry::HeadLimits()};
}

/// Seen by look 1 at `pixel`, `range_m` away and known to a fifth.
PlannedTarget target_at(const PlannedHead& robot, const geometry::Pixel& pixel, double range_m) {
  PlannedTarget target;
  target.direction_1 = *geometry::normalise(robot.rig.camera, pixel);
  target.inverse_depth_per_m = target.direction_1.homogeneous().norm() / range_m;
  target.inverse_depth_min_per_m = 0.8 * target.inverse_depth_per_m;
  target.inverse_depth_max_per_m = 1.2 * target.inverse_depth_per_m;
  target.half_size_px = 20.0;
  return target;
}

std::optional<geometry::Pixel> seen_at(const PlannedHead& robot, geometry::HeadAngles look_1,
                                       geometry::HeadAngles look, const PlannedTarget& target,
                                       double inverse_depth_per_m) {
  return geometry::project(robot.rig.camera,
                           geometry::cam2_from_cam1(robot.rig.head, look_1, look) *
                               (target.direction_1.homogeneous() / inverse_depth_per_m));
}

/// Eight looks at a target: the first given, the second by the step rule, the others planned.
std::vector<geometry::HeadAngles> eight_looks(const PlannedHead& robot, geometry::HeadAngles look_1,
                                              const geometry::Pixel& pixel,
                                              const PlannedTarget& target) {
  std::vector looks{look_1, next_look(robot.rig.camera, robot.limits, look_1, pixel)};
  while (looks.size() < 8) {
    const auto look = most_informative_look(robot, looks, looks.back(), target);
    if (!look) break;
    looks.push_back(*look);
  }
  return looks;
}

TEST(Planner, KeepsTheRulesConditionsAndTheTargetInView) {
  const PlannedHead robot = nao_v6();
  std::mt19937_64 random(1);
  const auto uniform = [&random](double from, double to) {
    return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  int planned = 0;
  constexpr int trials = 60;
  for (int i = 0; i < trials; ++i) {
    const geometry::Pixel pixel(uniform(60, 579), uniform(60, 419));
    const PlannedTarget target = target_at(robot, pixel, uniform(0.25, 3.0));
    const geometry::HeadAngles look_1 =
        robot.limits.clamp({uniform(-1.5, 1.5), uniform(-0.5, 0.4)});
    std::vector looks{look_1, next_look(robot.rig.camera, robot.limits, look_1, pixel)};
    const auto next = most_informative_look(robot, looks, looks.back(), target);
    if (!next) continue;
    ++planned;
    EXPECT_TRUE(robot.limits.contains_segment(looks.back(), *next));
    EXPECT_GE(std::abs(next->yaw_rad - looks.back().yaw_rad), minimum_step_rad - rounding_rad);
    EXPECT_GE(std::abs(next->pitch_rad - looks.back().pitch_rad), minimum_step_rad - rounding_rad);
    for (const double inverse_depth : {target.inverse_depth_min_per_m, target.inverse_depth_per_m,
                                       target.inverse_depth_max_per_m}) {
      const auto seen = seen_at(robot, look_1, *next, target, inverse_depth);
      ASSERT_TRUE(seen);
      EXPECT_TRUE(robot.rig.camera.contains(*seen, 40.0)) << seen->transpose();
    }
  }
  EXPECT_GE(planned, trials * 9 / 10);
}

TEST(Planner, StepsAreAsLongAsIsAsked) {
  PlannedHead robot = nao_v6();
  robot.least_step_rad = 0.18;
  const geometry::Pixel pixel(320.0, 240.0);
  const auto looks = eight_looks(robot, {}, pixel, target_at(robot, pixel, 1.0));
  ASSERT_EQ(looks.size(), 8U);
  for (std::size_t i = 2; i < looks.size(); ++i) {
    EXPECT_GE(std::abs(looks[i].yaw_rad - looks[i - 1].yaw_rad), 0.18 - rounding_rad);
    EXPECT_GE(std::abs(looks[i].pitch_rad - looks[i - 1].pitch_rad), 0.18 - rounding_rad);
  }
}

TEST(Planner, LooksClusterAtOppositeEndsOfTheField) {
  const PlannedHead robot = nao_v6();
  const geometry::Pixel pixel(320.0, 240.0);
  const auto looks = eight_looks(robot, {}, pixel, target_at(robot, pixel, 1.0));
  ASSERT_EQ(looks.size(), 8U);
  // Half the field is 0.484 rad, less the border and the step that two looks at one end are apart.
  const auto at_an_end = [](geometry::HeadAngles look) { return std::abs(look.yaw_rad) > 0.25; };
  EXPECT_GE(std::count_if(looks.begin() + 2, looks.end(), at_an_end), 5);
  EXPECT_GE(std::count_if(looks.begin(), looks.end(), [](auto a) { return a.yaw_rad > 0.25; }), 2);
  EXPECT_GE(std::count_if(looks.begin(), looks.end(), [](auto a) { return a.yaw_rad < -0.25; }), 2);
}

TEST(Planner, IsBetterThanRepeatingTheStepRule) {
  const PlannedHead robot = nao_v6();
  for (const double range_m : {0.3, 1.0}) {
    const geometry::Pixel pixel(320.0, 240.0);
    const PlannedTarget target = target_at(robot, pixel, range_m);
    const auto planned = eight_looks(robot, {}, pixel, target);
    std::vector<geometry::HeadAngles> ruled{geometry::HeadAngles{}};
    for (geometry::Pixel seen = pixel; ruled.size() < 8;) {
      ruled.push_back(next_look(robot.rig.camera, robot.limits, ruled.back(), seen));
      seen = *seen_at(robot, {}, ruled.back(), target, target.inverse_depth_per_m);
    }
    EXPECT_LT(planned_sigma_per_m(robot, planned, target),
              0.5 * planned_sigma_per_m(robot, ruled, target));
  }
}

TEST(Planner, AddsInformationWithEveryLook) {
  const PlannedHead robot = nao_v6();
  const geometry::Pixel pixel(200.0, 300.0);
  const PlannedTarget target = target_at(robot, pixel, 0.5);
  const auto looks = eight_looks(robot, {0.1, 0.1}, pixel, target);
  ASSERT_EQ(looks.size(), 8U);
  for (std::size_t n = 3; n <= looks.size(); ++n) {
    const std::span all(looks);
    EXPECT_LT(planned_sigma_per_m(robot, all.first(n), target),
              planned_sigma_per_m(robot, all.first(n - 1), target));
  }
}

TEST(Planner, OneLookTellsNothingOfTheRange) {
  const PlannedHead robot = nao_v6();
  const std::array look_1{geometry::HeadAngles{}};
  EXPECT_EQ(planned_sigma_per_m(robot, look_1, target_at(robot, {320, 240}, 0.5)),
            std::numeric_limits<double>::infinity());
}

TEST(Planner, FindsNoLookAtWhatTheHeadCannotTurnTo) {
  // Far above: at the upper limit of pitch the target stands at the image's upper border, and
  // nothing that sees it is a step of 0.1 rad away on both axes.
  const PlannedHead robot = nao_v6();
  const geometry::HeadAngles highest{0.0, robot.limits.pitch_range(0.0).min_rad};
  const std::array looks{highest};
  EXPECT_FALSE(most_informative_look(robot, looks, highest, target_at(robot, {320, 50}, 1.0)));
}

TEST(Planner, KeepsMostOfALargeTargetInTheImage) {
  const PlannedHead robot = nao_v6();
  const geometry::Pixel pixel(320.0, 240.0);
  PlannedTarget target = target_at(robot, pixel, 0.3);
  target.inverse_depth_min_per_m = target.inverse_depth_max_per_m = target.inverse_depth_per_m;
  target.half_size_px = 90.0;
  for (const geometry::HeadAngles look : eight_looks(robot, {}, pixel, target)) {
    const geometry::Pixel seen = *seen_at(robot, {}, look, target, target.inverse_depth_per_m);
    const auto share = [&](double at, double size) {
      return std::min(
          1.0, (std::min(at, size - 1.0 - at) + target.half_size_px) / (2.0 * target.half_size_px));
    };
    EXPECT_GT(share(seen.x(), 640.0) * share(seen.y(), 480.0), 0.85) << seen.transpose();
  }
}

TEST(Planner, AlsoForExactEncodersAndPixels) {
  PlannedHead robot = nao_v6();
  robot.rig.uncertainty = {};
  const geometry::Pixel pixel(320.0, 240.0);
  EXPECT_EQ(eight_looks(robot, {}, pixel, target_at(robot, pixel, 1.0)).size(), 8U);
}

TEST(Approach, StraightWhereBothAxesComeFromTheirSide) {
  EXPECT_FALSE(approach_point(geometry::HeadLimits(), {}, {0.3, 0.2}, {1.0, 1.0}, 0.08));
  EXPECT_FALSE(approach_point(geometry::HeadLimits(), {}, {-0.3, 0.2}, {-0.1, 0.1}, 0.08));
}

TEST(Approach, BeyondTheGoalOnAxesThatComeFromTheOther) {
  const auto via = approach_point(geometry::HeadLimits(), {}, {-0.3, 0.2}, {0.1, 0.1}, 0.08);
  ASSERT_TRUE(via);
  EXPECT_EQ(via->yaw_rad, -0.3 - 0.08);
  EXPECT_EQ(via->pitch_rad, 0.2);
}

TEST(Approach, StraightWhereTheDetourLeavesTheLimits) {
  const geometry::HeadLimits limits;
  const double end = limits.yaw_range().max_rad - 0.01;
  EXPECT_FALSE(approach_point(limits, {end - 0.3, 0.0}, {end, 0.1}, {-0.1, 0.1}, 0.08));
}

}  // namespace
}  // namespace gazed::gaze::planner_test
