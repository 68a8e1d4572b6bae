#include "agent/cycle/head_history.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

namespace gazed::cycle::head_history_test {
namespace {

constexpr double limit_rad_s = 0.1;
constexpr std::int64_t period_us = 12'000;             // LoLA's cycle
constexpr double interpolation_tolerance_rad = 1e-12;  // linear, in double precision

geometry::HeadState still_at(std::int64_t utime_us, geometry::HeadAngles angles = {}) {
  return {utime_us, angles, {0.0, 0.0}};
}
geometry::HeadState moving_at(std::int64_t utime_us, geometry::HeadAngles angles = {}) {
  return {utime_us, angles, {1.0, 0.0}};
}

TEST(HeadHistory, InterpolatesToTheCapture) {
  HeadHistory dut(limit_rad_s);
  dut.add(still_at(1'000, {0.1, -0.2}));
  dut.add(still_at(2'000, {0.3, -0.1}));
  const auto head = dut.at(1'250);
  ASSERT_TRUE(head);
  EXPECT_NEAR(head->measured.yaw_rad, 0.15, interpolation_tolerance_rad);
  EXPECT_NEAR(head->measured.pitch_rad, -0.175, interpolation_tolerance_rad);
}

TEST(HeadHistory, ACaptureThatLastsHasTheAnglesOfItsMiddleAndASweep) {
  HeadHistory dut(limit_rad_s);
  for (int i = 0; i <= 6; ++i) dut.add(still_at(i * period_us, {0.001 * i, -0.002 * i}));
  const auto head = dut.during(2 * period_us, 3 * period_us);
  ASSERT_TRUE(head);
  EXPECT_NEAR(head->measured.yaw_rad, 0.0035, interpolation_tolerance_rad);
  EXPECT_NEAR(head->measured.pitch_rad, -0.007, interpolation_tolerance_rad);
  EXPECT_NEAR(head->sweep.yaw_rad, 0.003, interpolation_tolerance_rad);
  EXPECT_NEAR(head->sweep.pitch_rad, -0.006, interpolation_tolerance_rad);
  EXPECT_GT(head->sweep_sigma_rad, 0.0);
  EXPECT_TRUE(head->still);
  EXPECT_FALSE(dut.during(5 * period_us, 2 * period_us));  // its end is not known yet
}

TEST(HeadHistory, ACaptureOfNoLengthIsThatOfItsInstant) {
  HeadHistory dut(limit_rad_s);
  for (int i = 0; i <= 4; ++i) dut.add(still_at(i * period_us, {0.0013 * i, -0.0027 * i}));
  const auto instant = dut.at(40'000), capture = dut.during(40'000, 0);
  ASSERT_TRUE(instant && capture);
  EXPECT_EQ(capture->measured, instant->measured);
  EXPECT_EQ(capture->still, instant->still);
  EXPECT_EQ(capture->sweep, geometry::HeadAngles());
}

TEST(HeadHistory, ACaptureInWhichAMoveBeginsIsNotStill) {
  HeadHistory dut(limit_rad_s);
  for (int i = 0; i <= 4; ++i) dut.add(still_at(i * period_us));
  dut.add(moving_at(5 * period_us));
  EXPECT_TRUE(dut.during(2 * period_us, 2 * period_us)->still);
  EXPECT_FALSE(dut.during(2 * period_us, 3 * period_us)->still);
}

TEST(HeadHistory, HowLongAnglesAreKeptFollowsFromTheRateAtWhichTheyCome) {
  HeadHistory dut(limit_rad_s);
  dut.add(still_at(0));
  EXPECT_EQ(dut.kept_s(), INFINITY) << "not known yet";
  for (int i = 1; i <= 20; ++i) dut.add(still_at(i * period_us));
  const double told_early_s = dut.kept_s();
  for (int i = 21; i <= 1000; ++i) dut.add(still_at(i * period_us));
  constexpr double tolerance_s = 1e-9;  // rounding
  EXPECT_NEAR(told_early_s, 1e-6 * static_cast<double>(1000 * period_us - dut.oldest_utime_us()),
              tolerance_s);
  EXPECT_NEAR(dut.kept_s(), told_early_s, tolerance_s);
}

TEST(HeadHistory, KnowsNothingOutsideItsSamples) {
  HeadHistory dut(limit_rad_s);
  EXPECT_FALSE(dut.at(0));
  dut.add(still_at(1'000));
  dut.add(still_at(2'000));
  EXPECT_FALSE(dut.at(999));
  EXPECT_FALSE(dut.at(2'001));
  EXPECT_TRUE(dut.at(1'000));
  EXPECT_TRUE(dut.at(2'000));
}

TEST(HeadHistory, IsStillAfterTwoStillSamplesAndBeforeAThird) {
  HeadHistory dut(limit_rad_s);
  dut.add(moving_at(1'000));
  dut.add(still_at(2'000));
  dut.add(still_at(3'000));
  dut.add(still_at(4'000));
  EXPECT_FALSE(dut.at(2'500)->still);
  EXPECT_TRUE(dut.at(3'500)->still);
}

TEST(HeadHistory, AMoveThatBeginsRightAfterTheCaptureIsSeen) {
  HeadHistory dut(limit_rad_s);
  for (int i = 1; i <= 3; ++i) dut.add(still_at(i * period_us));
  dut.add(moving_at(4 * period_us));
  EXPECT_FALSE(dut.at(3 * period_us + 1)->still);
}

TEST(HeadHistory, AfterARestartOnlyLaterSamplesCount) {
  HeadHistory dut(limit_rad_s);
  for (int i = 1; i <= 4; ++i) dut.add(still_at(i * period_us));
  dut.restart(3 * period_us);
  EXPECT_FALSE(dut.at(4 * period_us)->still);
  dut.add(still_at(5 * period_us));
  dut.add(still_at(6 * period_us));
  EXPECT_FALSE(dut.at(4 * period_us + 1)->still);
  EXPECT_TRUE(dut.at(5 * period_us + 1)->still);
}

TEST(HeadHistory, RefusesWhatIsNoMeasurement) {
  HeadHistory dut(limit_rad_s);
  ASSERT_TRUE(dut.add(still_at(1'000)));
  EXPECT_FALSE(dut.add(still_at(1'000)));
  EXPECT_FALSE(dut.add(still_at(999)));
  EXPECT_FALSE(dut.add(still_at(2'000, {NAN, 0.0})));
  EXPECT_FALSE(dut.add(still_at(2'000, {0.0, INFINITY})));
  EXPECT_FALSE(dut.add(still_at(INT64_MIN)));
  EXPECT_FALSE(dut.add(still_at(INT64_MAX)));
  EXPECT_EQ(dut.newest().utime_us, 1'000);
}

TEST(HeadHistory, AVelocityThatIsNotMeasuredIsTakenFromTheAngles) {
  HeadHistory dut(limit_rad_s);
  const geometry::HeadAngles unknown{NAN, NAN};
  // An encoder step of 1.53 mrad from sample to sample is no motion.
  for (int i = 0; i < 10; ++i) dut.add({i * period_us, {i % 2 == 0 ? 0.0 : 0.00153, 0.0}, unknown});
  EXPECT_TRUE(dut.still_now());
  for (int i = 10; i < 20; ++i) dut.add({i * period_us, {0.01 * (i - 9), 0.0}, unknown});
  EXPECT_FALSE(dut.still_now());
}

/// A head of LoLA's rate that creeps into its goal; what it measures comes in the encoder's steps.
geometry::HeadAngles creeping(std::int64_t utime_us) {
  constexpr double step_rad = 0.00153, time_constant_s = 0.08;
  const double left_rad = 0.1 * std::exp(-1e-6 * static_cast<double>(utime_us) / time_constant_s);
  return {step_rad * std::round((0.1 - left_rad) / step_rad), 0.0};
}

TEST(HeadHistory, AHeadThatCreepsIntoItsGoalIsStillWhenItHardlyMoves) {
  constexpr double creep_limit_rad_s = 0.02;
  HeadHistory dut(creep_limit_rad_s);
  std::int64_t utime_us = -200'000;
  for (; utime_us < 1'000'000 && !(utime_us > 0 && dut.still_now()); utime_us += period_us) {
    dut.add({utime_us, creeping(std::max<std::int64_t>(utime_us, 0)), {NAN, NAN}});
  }
  // 0.1 rad / 80 ms falls to 0.02 rad/s after 0.33 s.
  EXPECT_GT(utime_us, 330'000);
  EXPECT_LT(utime_us, 500'000);
}

TEST(HeadHistory, VelocitiesThatContradictTheAnglesAreNotBelieved) {
  HeadHistory dut(limit_rad_s);
  for (int i = 0; i < 20; ++i) dut.add(still_at(i * period_us));
  EXPECT_TRUE(dut.still_now());
  EXPECT_EQ(dut.warning(), "");
  // 2.5 rad/s, and velocities of zero: what a driver without velocities fills in.
  for (int i = 20; i < 25; ++i) dut.add(still_at(i * period_us, {0.03 * (i - 19), 0.0}));
  EXPECT_FALSE(dut.still_now());
  EXPECT_NE(dut.warning(), "");
  EXPECT_EQ(dut.warning(), "") << "told once";
  for (int i = 25; i < 40; ++i) dut.add(still_at(i * period_us, {0.18, 0.0}));
  EXPECT_TRUE(dut.still_now());
}

TEST(HeadHistory, VelocitiesOfAMoveThatTheAnglesShowAreBelieved) {
  HeadHistory dut(limit_rad_s, 0.02);
  geometry::HeadAngles angles{};
  for (int i = 0; i < 40; ++i) {
    const double speed = i > 10 && i < 20 ? 2.5 : 0.0;
    angles.yaw_rad += 1e-6 * speed * period_us;
    // Its encoder is off by another 30 mrad after the move.
    dut.add({i * period_us, {angles.yaw_rad + (i < 15 ? 0.0 : 0.03), 0.0}, {speed, 0.0}});
  }
  EXPECT_EQ(dut.warning(), "");
}

TEST(HeadHistory, SamplesFarApartAreJudgedByTheirAngles) {
  HeadHistory dut(limit_rad_s);
  for (int i = 0; i < 5; ++i) dut.add(still_at(i * 100'000, {0.05 * i, 0.0}));
  EXPECT_FALSE(dut.still_now());
  for (int i = 5; i < 10; ++i) dut.add(still_at(i * 100'000, {0.2, 0.0}));
  EXPECT_TRUE(dut.still_now());
}

TEST(HeadHistory, ForgetsTheOldestFirst) {
  HeadHistory dut(limit_rad_s);
  constexpr int samples = 300;
  for (int i = 0; i < samples; ++i) dut.add(still_at(i * period_us, {0.001 * i, 0.0}));
  EXPECT_FALSE(dut.at(0));
  EXPECT_GT(dut.oldest_utime_us(), 0);
  const auto head = dut.at(250 * period_us);
  ASSERT_TRUE(head);
  EXPECT_NEAR(head->measured.yaw_rad, 0.25, interpolation_tolerance_rad);
}

}  // namespace
}  // namespace gazed::cycle::head_history_test
