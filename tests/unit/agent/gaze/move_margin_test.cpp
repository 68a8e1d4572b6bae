// What keeps the step rule in the move as well as in the command.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <random>

#include "agent/gaze/step_rule.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::gaze::move_margin_test {
namespace {

constexpr double rounding_rad = 1e-12;
constexpr double margin_rad = 0.04;

MATCHER_P2(IsAt, yaw_rad, pitch_rad, "") {
  *result_listener << "yaw " << arg.yaw_rad << ", pitch " << arg.pitch_rad;
  return std::abs(arg.yaw_rad - yaw_rad) <= rounding_rad &&
         std::abs(arg.pitch_rad - pitch_rad) <= rounding_rad;
}

TEST(MoveMargin, LengthensBothAxesTheirOwnWay) {
  const geometry::HeadLimits limits;
  EXPECT_THAT(with_margin(limits, {}, {0.1, -0.1}, margin_rad), IsAt(0.14, -0.14));
  EXPECT_THAT(with_margin(limits, {0.5, 0.1}, {0.2, 0.2}, margin_rad), IsAt(0.16, 0.24));
  EXPECT_THAT(with_margin(limits, {}, {0.1, 0.1}, 0.0), IsAt(0.1, 0.1));
}

TEST(MoveMargin, IsWhatTheLimitsLeaveOfIt) {
  const geometry::HeadLimits limits;
  const double yaw_max = limits.yaw_range().max_rad;
  const geometry::HeadAngles look{yaw_max - 0.01, 0.1};
  EXPECT_THAT(with_margin(limits, {1.9, 0.0}, look, margin_rad), IsAt(yaw_max, 0.14));
  const geometry::HeadAngles down{0.1, limits.pitch_range(0.14).max_rad - 0.01};
  EXPECT_THAT(with_margin(limits, {0.0, 0.3}, down, margin_rad),
              IsAt(0.14, limits.pitch_range(0.14).max_rad));
}

// Whatever the rule asks for, the longer move is inside all the way, and no axis is shorter.
TEST(MoveMargin, NeverLeavesTheLimitsNorShortensAMove) {
  const geometry::CameraModel camera = geometry::robot_profile("nao-v6")->rig.camera;
  std::mt19937_64 random(1);
  const auto uniform = [&random](double from, double to) {
    return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (const double limits_margin_rad : {0.0, 0.03, 0.15}) {
    const geometry::HeadLimits limits(limits_margin_rad);
    for (int i = 0; i < 20'000; ++i) {
      const geometry::HeadAngles start = limits.clamp({uniform(-2.2, 2.2), uniform(-0.7, 0.6)});
      const geometry::Pixel pixel(uniform(0.0, 639.0), uniform(0.0, 479.0));
      const geometry::HeadAngles ruled = next_look(camera, limits, start, pixel);
      const geometry::HeadAngles longer = with_margin(limits, start, ruled, margin_rad);
      ASSERT_TRUE(limits.contains_segment(start, longer));
      const geometry::HeadAngles change = ruled - start, by = longer - ruled;
      ASSERT_GE(by.yaw_rad * change.yaw_rad, 0.0);
      ASSERT_GE(by.pitch_rad * change.pitch_rad, 0.0);
    }
  }
}

TEST(TurnOn, NotWhereBothAxesMadeTheirStep) {
  const geometry::HeadLimits limits;
  EXPECT_FALSE(turn_on(limits, {}, {0.14, 0.14}, {0.1, 0.2}, margin_rad));
  EXPECT_FALSE(turn_on(limits, {}, {-0.14, 0.14}, {-0.12, 0.11}, margin_rad));
}

TEST(TurnOn, ByWhatIsMissingAndTheMarginOnTheAxisThatFellShort) {
  const geometry::HeadLimits limits;
  const auto on = turn_on(limits, {}, {-0.14, 0.14}, {-0.09, 0.12}, margin_rad);
  ASSERT_TRUE(on);
  EXPECT_THAT(*on, IsAt(-0.19, 0.14));
}

TEST(TurnOn, AlsoWhereAnAxisWentTheWrongWay) {
  const geometry::HeadLimits limits;
  const auto on = turn_on(limits, {}, {0.14, 0.14}, {0.12, -0.01}, margin_rad);
  ASSERT_TRUE(on);
  EXPECT_THAT(*on, IsAt(0.14, 0.14 + 0.11 + margin_rad));
}

TEST(TurnOn, NotWhereTheLimitsLeaveNoRoomForIt) {
  const geometry::HeadLimits limits;
  const double end = limits.yaw_range().max_rad;
  EXPECT_FALSE(
      turn_on(limits, {end - 0.11, 0.0}, {end - 0.005, 0.14}, {end - 0.03, 0.14}, margin_rad));
  EXPECT_TRUE(
      turn_on(limits, {end - 0.16, 0.0}, {end - 0.03, 0.14}, {end - 0.07, 0.14}, margin_rad));
}

}  // namespace
}  // namespace gazed::gaze::move_margin_test
