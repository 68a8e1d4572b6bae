#include "agent/gaze/step_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <string_view>
#include <vector>

#include "agent/geometry/robot.hpp"

namespace gazed::gaze::step_rule_test {
namespace {

// Sums, differences and interpolations of angles of a few radians round at about 4e-16.
constexpr double rounding_rad = 1e-12;

MATCHER_P2(IsLook, yaw_rad, pitch_rad, "") {
  *result_listener << "yaw " << arg.yaw_rad << ", pitch " << arg.pitch_rad;
  return std::abs(arg.yaw_rad - yaw_rad) <= rounding_rad &&
         std::abs(arg.pitch_rad - pitch_rad) <= rounding_rad;
}

geometry::CameraModel camera_of(std::string_view robot) {
  return geometry::robot_profile(robot)->camera;
}

// All examples: nao-v6, 640x480 pixels, f = 608 px, so half the field of view is atan(320/608) by
// atan(240/608), and a pixel one half field from the centre is at (0 or 639, 0 or 479).
constexpr double half_width_rad = 0.4844779290370232;
constexpr double half_height_rad = 0.3759609538713056;
const geometry::Pixel centre{319.5, 239.5};
const geometry::Pixel left{0.0, 239.5};
const geometry::Pixel right{639.0, 239.5};
const geometry::Pixel bottom{319.5, 479.0};

geometry::HeadAngles look_from(geometry::HeadAngles start, const geometry::Pixel& salient) {
  return next_look(camera_of("nao-v6"), geometry::HeadLimits(), start, salient);
}

TEST(StepRule, CentrePixelMovesTheLeastStepLeftAndDown) {
  EXPECT_THAT(look_from({0.0, 0.0}, centre), IsLook(0.1, 0.1));
  EXPECT_THAT(look_from({0.2, -0.3}, centre), IsLook(0.3, -0.2));
}

TEST(StepRule, ZeroOfEitherSignCountsAsPositive) {
  // The yaw change is minus the relative coordinate: -0.0 in the centre column.
  EXPECT_THAT(look_from({}, {centre.x(), 0.0}), IsLook(0.1, -half_height_rad));
  EXPECT_THAT(look_from({}, {0.0, centre.y()}), IsLook(half_width_rad, 0.1));
}

TEST(StepRule, CornerPixelsMoveByHalfTheFieldOfView) {
  const double w = half_width_rad, h = half_height_rad;
  EXPECT_THAT(look_from({}, {0.0, 0.0}), IsLook(w, -h));
  EXPECT_THAT(look_from({}, {639.0, 0.0}), IsLook(-w, -h));
  EXPECT_THAT(look_from({}, {0.0, 479.0}), IsLook(w, h));
  EXPECT_THAT(look_from({}, {639.0, 479.0}), IsLook(-w, h));
}

TEST(StepRule, ChangeIsLinearInThePixelAndTheLeastStepNearTheCentre) {
  // 80.5 px right of the centre is 0.122 rad, 60.5 px below it 0.095 rad: less than the least step.
  EXPECT_THAT(look_from({}, {400.0, 300.0}), IsLook(-80.5 / 319.5 * half_width_rad, 0.1));
  // 60.5 px right is 0.092 rad, 80.5 px above 0.126 rad.
  EXPECT_THAT(look_from({}, {380.0, 159.0}), IsLook(-0.1, -80.5 / 239.5 * half_height_rad));
}

TEST(StepRule, JustOffTheCentreTheSignDecides) {
  EXPECT_THAT(look_from({}, {319.6, 239.4}), IsLook(-0.1, -0.1));
  EXPECT_THAT(look_from({}, {319.4, 239.6}), IsLook(0.1, 0.1));
}

TEST(StepRule, AtTheYawLimitTheStepIsReduced) {
  // 1.9 + 0.484 is beyond 2.08567; the reduced change is 0.186.
  EXPECT_THAT(look_from({1.9, 0.0}, left), IsLook(2.08567, 0.1));
  EXPECT_THAT(look_from({-1.9, 0.0}, right), IsLook(-2.08567, 0.1));
}

TEST(StepRule, AtTheYawLimitAStepReducedTooFarGoesTheOtherWay) {
  EXPECT_THAT(look_from({2.0, 0.0}, left), IsLook(1.9, 0.1));
  EXPECT_THAT(look_from({-2.08567, 0.0}, right), IsLook(-1.98567, 0.1));
}

TEST(StepRule, AtThePitchLimitOfTheNewYawTheStepIsReduced) {
  // The table's maximum at yaw 0.1, between its rows at 0 and 0.486074.
  const double limit = 0.515047 + 0.1 / 0.486074 * (0.422021 - 0.515047);
  EXPECT_THAT(look_from({0.0, 0.3}, bottom), IsLook(0.1, limit));
}

TEST(StepRule, AtThePitchLimitAStepReducedTooFarGoesTheOtherWay) {
  EXPECT_THAT(look_from({0.0, 0.5}, bottom), IsLook(0.1, 0.4));
  EXPECT_THAT(look_from({0.0, -0.6}, {319.5, 0.0}), IsLook(0.1, -0.5));
}

TEST(StepRule, PitchGoesFurtherWhereTheLimitAtTheNewYawAsksForIt) {
  // From yaw 1.0 half a field to the left, where the table's minimum has risen above -0.45 + 0.1.
  const double yaw = 1.0 + half_width_rad;
  const double limit =
      -0.430049 + (yaw - 1.089958) / (1.526988 - 1.089958) * (-0.330041 - -0.430049);
  ASSERT_GT(limit, -0.35);
  EXPECT_THAT(look_from({1.0, -0.45}, left), IsLook(yaw, limit));
  // Upwards there is no room at all: down instead, and as far as the limit asks.
  EXPECT_THAT(look_from({1.0, -0.45}, {0.0, 0.0}), IsLook(yaw, limit));
}

TEST(StepRule, PitchGoesFurtherWhereTheWayWouldLeaveTheLimits) {
  // As before, from just inside the minimum at yaw 1.0. The limit at the row of 1.089958, passed
  // after 0.186 of the way, asks for more than the one at the end.
  const double yaw = 1.0 + half_width_rad;
  const double part = (1.089958 - 1.0) / half_width_rad;
  const geometry::HeadAngles start{1.0, -0.454};
  const double needed = start.pitch_rad + (-0.430049 - start.pitch_rad) / part;
  EXPECT_THAT(look_from(start, left), IsLook(yaw, needed));
  EXPECT_TRUE(geometry::HeadLimits().contains_segment(start, look_from(start, left)));
}

TEST(StepRule, PitchIsReducedWhereTheWayWouldLeaveTheLimits) {
  // Past the narrowest place, the row of 1.526988, to a yaw where the range is wider again.
  const geometry::Pixel bottom_right{639.0, 479.0};
  const geometry::HeadAngles start{1.6, 0.184};
  const double yaw = 1.6 - half_width_rad;
  const double part = (1.6 - 1.526988) / half_width_rad;
  const double on_the_way = start.pitch_rad + (0.200015 - start.pitch_rad) / part;
  ASSERT_LT(on_the_way, geometry::HeadLimits().pitch_range(yaw).max_rad);
  EXPECT_THAT(look_from(start, bottom_right), IsLook(yaw, on_the_way));
  EXPECT_TRUE(geometry::HeadLimits().contains_segment(start, look_from(start, bottom_right)));
  // From 0.19 the reduced change would be 0.066.
  EXPECT_THAT(look_from({1.6, 0.19}, bottom_right), IsLook(yaw, 0.09));
}

TEST(StepRule, YawGoesTheOtherWayWhereNoPitchKeepsTheWayInside) {
  // Half a field of 1.385 rad to the left is reduced to 1.93567. Starting on the minimum, the
  // segment must rise by 0.068068 until the row of 0.903033; kept up that slope ends at 0.148, and
  // the maximum there is 0.145.
  geometry::CameraModel wide = camera_of("nao-v6");
  wide.focal_px = {60.0, 60.0};
  const geometry::HeadLimits limits(0.15);
  const geometry::HeadAngles start{0.756077, -0.548033 + 0.15};
  EXPECT_THAT(next_look(wide, limits, start, left), IsLook(0.656077, start.pitch_rad + 0.1));
}

TEST(StepRule, AStepThatWasJustSetIsNotComparedAgain) {
  // (start + 0.1) - start rounds below 0.1 here: comparing would turn the step round.
  const double start = 0.7;
  ASSERT_LT((start + 0.1) - start, 0.1);
  EXPECT_THAT(look_from({start, 0.0}, centre), IsLook(0.8, 0.1));
}

TEST(StepRule, StartOutsideTheLimitsIsTakenAsTheNearestInside) {
  EXPECT_THAT(look_from({2.2, 0.0}, left), IsLook(2.08567 - 0.1, 0.1));
  EXPECT_THAT(look_from({0.0, 1.0}, bottom), IsLook(0.1, 0.514872 - 0.1));
}

// Draws that are the same everywhere (std distributions are not).
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : bits_(seed) {}
  double uniform(double min, double max) {
    return min + (max - min) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  bool one_in(std::uint64_t n) { return bits_() % n == 0; }
  template <typename Values>
  auto one_of(const Values& values) {
    return values[bits_() % std::size(values)];
  }

 private:
  std::mt19937_64 bits_;
};

// Any start inside, often on a limit, at a row of the table or a hair beside one.
geometry::HeadAngles draw_start(Draws& draws, const geometry::HeadLimits& limits) {
  const geometry::AngleRange yaws = limits.yaw_range();
  double yaw = draws.uniform(yaws.min_rad, yaws.max_rad);
  if (draws.one_in(4)) {
    yaw = draws.one_of(geometry::HeadLimits::break_yaws_rad()) +
          draws.one_of(std::array{0.0, 1e-16, -1e-16, 1e-9, -1e-9, 1e-3, -1e-3});
  }
  yaw = std::clamp(yaw, yaws.min_rad, yaws.max_rad);
  const geometry::AngleRange pitches = limits.pitch_range(yaw);
  if (draws.one_in(4)) return {yaw, draws.one_of(std::array{pitches.min_rad, pitches.max_rad})};
  return {yaw, draws.uniform(pitches.min_rad, pitches.max_rad)};
}

geometry::Pixel draw_pixel(Draws& draws, const geometry::CameraModel& camera) {
  const auto coordinate = [&](int size_px) {
    const double last_px = size_px - 1;
    if (draws.one_in(8)) return draws.one_of(std::array{0.0, last_px / 2.0, last_px});
    return draws.uniform(0.0, last_px);
  };
  const double x = coordinate(camera.width_px);
  return {x, coordinate(camera.height_px)};
}

// The way from start to end at every row of the table that it passes and at 16 places more.
bool way_is_inside(const geometry::HeadLimits& limits, geometry::HeadAngles start,
                   geometry::HeadAngles end) {
  const auto inside = [&](double part) {
    const double yaw = start.yaw_rad + part * (end.yaw_rad - start.yaw_rad);
    const double pitch = start.pitch_rad + part * (end.pitch_rad - start.pitch_rad);
    const geometry::AngleRange range = limits.pitch_range(yaw);
    return pitch >= range.min_rad - rounding_rad && pitch <= range.max_rad + rounding_rad;
  };
  for (const double yaw : geometry::HeadLimits::break_yaws_rad()) {
    const double part = (yaw - start.yaw_rad) / (end.yaw_rad - start.yaw_rad);
    if (part > 0.0 && part < 1.0 && !inside(part)) return false;
  }
  for (int i = 1; i <= 16; ++i) {
    if (!inside(i / 17.0)) return false;
  }
  return true;
}

void expect_property(Draws& draws, const geometry::CameraModel& camera,
                     const geometry::HeadLimits& limits, int count) {
  for (int i = 0; i < count; ++i) {
    const geometry::HeadAngles start = draw_start(draws, limits);
    ASSERT_TRUE(limits.contains(start));
    const geometry::Pixel pixel = draw_pixel(draws, camera);
    const geometry::HeadAngles end = next_look(camera, limits, start, pixel);
    const geometry::HeadAngles change = end - start;
    ASSERT_TRUE(limits.contains(end) && limits.contains_segment(start, end) &&
                way_is_inside(limits, start, end) &&
                std::abs(change.yaw_rad) >= minimum_step_rad - rounding_rad &&
                std::abs(change.pitch_rad) >= minimum_step_rad - rounding_rad)
        << "margin " << limits.margin_rad() << ", focal length " << camera.focal_px.x()
        << " px, start " << start.yaw_rad << ", " << start.pitch_rad << ", pixel "
        << pixel.transpose() << ", end " << end.yaw_rad << ", " << end.pitch_rad;
  }
}

class StepRuleProperty : public testing::TestWithParam<double> {};

TEST_P(StepRuleProperty, StaysInsideAllTheWayAndMovesBothJointsByTheLeastStep) {
  // 4 margins and 5 cameras: two million in all.
  constexpr int draws_per_camera = GAZED_STEP_RULE_DRAWS;
  const geometry::HeadLimits limits(GetParam());
  Draws draws(20110629);
  std::vector<geometry::CameraModel> cameras{camera_of("nao-v3"), camera_of("nao-v4"),
                                             camera_of("nao-v6")};
  for (const double focal_px : {60.0, 6000.0}) {  // half fields of 79 and 3 degrees
    cameras.push_back(cameras.front());
    cameras.back().focal_px = {focal_px, focal_px};
  }
  for (const geometry::CameraModel& camera : cameras) {
    expect_property(draws, camera, limits, draws_per_camera);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Margins, StepRuleProperty,
                         testing::Values(0.0, 0.02, 0.1, geometry::max_margin_rad));

}  // namespace
}  // namespace gazed::gaze::step_rule_test
