#include "drivers/naoqi/robot_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>

namespace gazed::naoqi::robot_clock_test {
namespace {

TEST(RobotClock, TheLeastDelayCountsAsTheDifference) {
  constexpr std::int64_t ahead_us = 4'000'000'000;
  RobotClock dut;
  std::int64_t here_us = 0;
  for (int i = 0; i < 100; ++i) {
    const std::int64_t exposed_us = 33'000 * i;
    const std::int64_t delay_us = 20'000 + (i * 7919) % 50'000;  // 20 to 70 ms
    here_us = dut.here_us(exposed_us + ahead_us, exposed_us + delay_us).value() - exposed_us;
  }
  EXPECT_GE(here_us, 20'000);
  EXPECT_LE(here_us, 21'000);
}

TEST(RobotClock, ClocksThatDriftApartAreFollowed) {
  RobotClock dut;
  double worst_us = 0.0;
  for (int i = 0; i < 30'000; ++i) {
    const std::int64_t exposed_us = 33'000LL * i;
    const auto stamp_us = static_cast<std::int64_t>(1.0001 * static_cast<double>(exposed_us));
    const auto error_us =
        static_cast<double>(dut.here_us(stamp_us, exposed_us).value() - exposed_us);
    worst_us = std::max(worst_us, std::abs(error_us));
  }
  EXPECT_LE(worst_us, 1'001.0);  // 100 ppm of two windows of 5 s
}

TEST(RobotClock, AClockThatIsSetIsBelievedWithTheSecondStamp) {
  constexpr std::int64_t now_us = 5'000'000'000;
  RobotClock dut;
  EXPECT_EQ(dut.here_us(now_us, now_us), now_us);
  for (const std::int64_t ahead_us : {3'600'000'000LL, -3'600'000'000LL, 2'000'000LL}) {
    EXPECT_EQ(dut.here_us(now_us + ahead_us, now_us), std::nullopt);
    EXPECT_EQ(dut.here_us(now_us + ahead_us, now_us), now_us);
  }
}

TEST(RobotClock, AStampThatCameLateIsNoSetClock) {
  constexpr std::int64_t now_us = 5'000'000'000;
  RobotClock dut;
  EXPECT_EQ(dut.here_us(now_us, now_us), now_us);
  EXPECT_EQ(dut.here_us(now_us, now_us + 1'500'000), std::nullopt);
  EXPECT_EQ(dut.here_us(now_us + 1'600'000, now_us + 1'600'000), now_us + 1'600'000);
  EXPECT_EQ(dut.here_us(now_us + 1'600'000, now_us + 3'100'000), std::nullopt);
}

}  // namespace
}  // namespace gazed::naoqi::robot_clock_test
