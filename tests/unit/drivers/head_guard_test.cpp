#include "drivers/head_guard.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "agent/geometry/limits.hpp"

#include "tests/unit/trials.hpp"

namespace gazed::drivers::head_guard_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double cycles_s = 0.025;  // a time is met within two cycles of 12 ms
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Admit, LeavesWhatIsAllowed) {
  const auto admitted = admit({123, {0.3, -0.2}, 0.4});
  ASSERT_TRUE(admitted);
  EXPECT_EQ(admitted->utime_us, 123);
  EXPECT_EQ(admitted->target, (geometry::HeadAngles{0.3, -0.2}));
  EXPECT_EQ(admitted->speed_fraction, 0.4);
}

TEST(Admit, RefusesWhatIsNoCommand) {
  EXPECT_FALSE(admit({0, {nan, 0.0}, 0.3}));
  EXPECT_FALSE(admit({0, {0.0, nan}, 0.3}));
  EXPECT_FALSE(admit({0, {infinity, 0.0}, 0.3}));
  EXPECT_FALSE(admit({0, {0.0, -infinity}, 0.3}));
  EXPECT_FALSE(admit({0, {0.0, 0.0}, nan}));
  EXPECT_FALSE(admit({0, {0.0, 0.0}, 0.0}));
  EXPECT_FALSE(admit({0, {0.0, 0.0}, -1.0}));
}

TEST(Admit, ClampsIntoTheTableAndToTheGreatestSpeed) {
  const auto admitted = admit({0, {1e300, -1e300}, infinity});
  ASSERT_TRUE(admitted);
  EXPECT_TRUE(geometry::HeadLimits().contains(admitted->target));
  EXPECT_EQ(admitted->speed_fraction, 1.0);
}

// Any bits at all as a command's numbers.
TEST(Admit, WhateverIsSaidStaysInsideTheLimits) {
  std::mt19937_64 random(1);
  const auto any = [&] { return std::bit_cast<double>(std::uint64_t{random()}); };
  const geometry::HeadLimits limits;
  for (int i = 0; i < test::trials(1'000'000, 20'000); ++i) {
    const geometry::HeadCommand command{0, {any(), any()}, any()};
    const auto admitted = admit(command);
    if (!admitted) continue;
    ASSERT_TRUE(limits.contains(admitted->target))
        << command.target.yaw_rad << ' ' << command.target.pitch_rad;
    ASSERT_TRUE(admitted->speed_fraction > 0.0 && admitted->speed_fraction <= 1.0);
  }
}

/// A head that is looked at every 12 ms.
class WatchedHead : public testing::Test {
 protected:
  static constexpr std::int64_t cycle_us = 12'000;

  void watch_for(double seconds) {
    for (const std::int64_t end_us = reading_.time_us + std::llround(1e6 * seconds);
         reading_.time_us < end_us;) {
      reading_.time_us += cycle_us;
      guard_.watch(reading_, order_);
    }
  }
  void told(double yaw_rad, double pitch_rad = 0.0) { order_.set_point = {yaw_rad, pitch_rad}; }
  void at(double yaw_rad, double pitch_rad = 0.0) {
    reading_.yaw.angle_rad = yaw_rad;
    reading_.pitch.angle_rad = pitch_rad;
  }
  /// Watches until the guard backs off; at most so long. The seconds that it took.
  double seconds_to_back_off(double at_most_s = 10.0) {
    const std::int64_t start_us = reading_.time_us;
    while (!guard_.backs_off() &&
           1e-6 * static_cast<double>(reading_.time_us - start_us) < at_most_s)
      watch_for(0.012);
    return 1e-6 * static_cast<double>(reading_.time_us - start_us);
  }

  HeadGuard guard_;
  HeadReading reading_{1'000'000, {0.0, 0.7, 40.0, 0.1, 0}, {0.0, 0.7, 40.0, 0.1, 0}};
  HeadOrder order_{{}, 0.7};
};

TEST_F(WatchedHead, OneThatFollowsIsWell) {
  for (int i = 0; i < 1000; ++i) {
    const double place = 1.5 * std::sin(0.02 * i);
    told(place);
    at(1.5 * std::sin(0.02 * (i - 4)), 0.02);  // 48 ms later, and off by a head's settling error
    watch_for(0.012);
    ASSERT_THAT(guard_.fault(), IsEmpty()) << i;
    ASSERT_FALSE(guard_.backs_off());
  }
}

TEST_F(WatchedHead, AJumpOfTheSetPointHasItsTime) {
  watch_for(1.0);
  told(-1.5);
  for (double yaw = 0.0; yaw > -1.5; yaw -= 0.03) {  // 2.5 rad/s
    at(yaw);
    watch_for(0.012);
  }
  watch_for(2.0);
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, AStuckJointIsNoticedAfterASecond) {
  watch_for(1.0);
  told(0.5);
  EXPECT_NEAR(seconds_to_back_off(), 1.0, cycles_s);
  EXPECT_THAT(guard_.fault(),
              AllOf(HasSubstr("HeadYaw is stuck: at 0.000 rad"), HasSubstr("told 0.500")));
}

TEST_F(WatchedHead, APitchWithoutPowerIsNotCalledStuck) {
  reading_.pitch.current_a = 0.0;
  watch_for(0.5);
  told(0.0, 0.2);
  EXPECT_NEAR(seconds_to_back_off(), 0.5, cycles_s);
  EXPECT_EQ(guard_.fault(), "HeadPitch has no power: it draws no current at 0.000 rad, told 0.200");
}

TEST_F(WatchedHead, APitchThatSinksWithoutPowerIsNotMovedBySomebody) {
  watch_for(1.0);
  reading_.pitch.current_a = 0.0;
  for (double pitch = 0.0; pitch < 0.5 && !guard_.backs_off(); pitch += 0.01) {
    at(0.0, pitch);
    watch_for(0.012);
  }
  seconds_to_back_off(1.0);
  EXPECT_THAT(guard_.fault(), HasSubstr("HeadPitch has no power"));
}

TEST_F(WatchedHead, AJointThatIsSlowIsNotStuck) {
  watch_for(0.5);
  told(0.5);
  for (double yaw = 0.0; yaw < 0.5; yaw += 0.012 * 0.02) {  // 0.02 rad/s
    at(yaw);
    watch_for(0.012);
  }
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, LostStiffness) {
  watch_for(1.0);
  reading_.yaw.stiffness = 0.0;
  EXPECT_NEAR(seconds_to_back_off(), 0.5, cycles_s);
  EXPECT_EQ(guard_.fault(), "HeadYaw has lost its stiffness: 0.00, told 0.70");
}

TEST_F(WatchedHead, OneWhoseStiffnessIsLowIsLetBe) {
  order_.stiffness = 0.1;
  reading_.yaw.stiffness = -1.0;
  told(0.5);
  watch_for(5.0);
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, WhatTheRobotDoesNotSayIsNotJudged) {
  reading_.yaw = {.angle_rad = 0.0};
  reading_.pitch = {.angle_rad = 0.0};
  watch_for(5.0);
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, SomebodyElseMovesIt) {
  watch_for(1.0);
  at(0.0, 0.15);
  EXPECT_LT(seconds_to_back_off(), 0.15);
  EXPECT_EQ(guard_.fault(), "somebody else moves the head: HeadPitch at 0.150 rad, told 0.000");
}

TEST_F(WatchedHead, AReversedCommandIsNobodyElse) {
  told(1.0);
  at(0.9);
  watch_for(0.5);
  told(-1.0);
  at(1.2);  // goes on for a while
  watch_for(0.3);
  at(0.0);
  watch_for(0.3);
  at(-1.0);
  watch_for(3.0);
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, TooHotUntilItHasCooled) {
  watch_for(0.1);
  reading_.pitch.temperature_c = 76.0;
  watch_for(5.0);
  EXPECT_TRUE(guard_.backs_off());
  EXPECT_EQ(guard_.fault(), "HeadPitch is too hot: 76 C, over 75 C");
  reading_.pitch.temperature_c = 72.0;  // not cooled yet
  watch_for(5.0);
  EXPECT_TRUE(guard_.backs_off());
  reading_.pitch.temperature_c = 69.0;
  watch_for(1.02);
  EXPECT_FALSE(guard_.backs_off());
  watch_for(1.5);
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, TheJointThatIsHotNowIsNamed) {
  watch_for(0.1);
  reading_.pitch.temperature_c = 76.0;
  watch_for(0.1);
  reading_.yaw.temperature_c = 72.0;  // never was too hot
  watch_for(0.1);
  EXPECT_EQ(guard_.fault(), "HeadPitch is too hot: 76 C, over 75 C");
  reading_.yaw.temperature_c = 77.0;
  reading_.pitch.temperature_c = 69.0;
  watch_for(0.1);
  EXPECT_EQ(guard_.fault(), "HeadYaw is too hot: 77 C, over 75 C");
  reading_.pitch.temperature_c = 76.0;
  watch_for(0.1);
  reading_.pitch.temperature_c = 72.0;
  reading_.yaw.temperature_c = 60.0;
  watch_for(0.1);
  EXPECT_EQ(guard_.fault(), "HeadPitch is still too hot: 72 C, over 70 C");
}

TEST_F(WatchedHead, TheRobotsOwnStatusOfHeatCounts) {
  reading_.yaw.temperature_status = 2;
  watch_for(0.1);
  EXPECT_TRUE(guard_.backs_off());
  EXPECT_THAT(guard_.fault(),
              HasSubstr("HeadYaw is too hot: the robot gives it temperature status 2"));
}

TEST_F(WatchedHead, TriesAgainAfterASecondAndNoticesAgain) {
  watch_for(0.5);
  told(0.5);
  seconds_to_back_off();
  const double start_s = 1e-6 * static_cast<double>(reading_.time_us);
  while (guard_.backs_off()) watch_for(0.012);
  EXPECT_NEAR(1e-6 * static_cast<double>(reading_.time_us) - start_s, 1.0, cycles_s);
  EXPECT_THAT(guard_.fault(), HasSubstr("stuck")) << "told until it is over";
  EXPECT_NEAR(seconds_to_back_off(), 1.0, cycles_s);
}

TEST_F(WatchedHead, AFaultIsOverWhenTheHeadFollowsAgain) {
  watch_for(0.5);
  told(0.5);
  seconds_to_back_off();
  at(0.5);
  while (guard_.backs_off()) watch_for(0.012);
  watch_for(1.0);
  EXPECT_THAT(guard_.fault(), HasSubstr("stuck"));
  watch_for(0.5);
  EXPECT_THAT(guard_.fault(), IsEmpty());
}

TEST_F(WatchedHead, APauseOfTheReadingsIsNoFault) {
  watch_for(0.5);
  told(0.5);
  watch_for(0.5);
  reading_.time_us += 60'000'000;
  EXPECT_NEAR(seconds_to_back_off(), 1.0, cycles_s) << "observed anew";
}

}  // namespace
}  // namespace gazed::drivers::head_guard_test
