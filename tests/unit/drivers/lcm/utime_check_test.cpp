#include "drivers/lcm/utime_check.hpp"

#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "messages.hpp"

namespace gazed::lcm::utime_check_test {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t hour_us = 3'600'000'000;

TEST(UtimeCheck, ForwardIsFine) {
  UtimeCheck check;
  EXPECT_EQ(check.refusal(0), "");
  EXPECT_EQ(check.refusal(1), "");
  EXPECT_EQ(check.refusal(hour_us + 1), "");
}

TEST(UtimeCheck, BackwardAndStanding) {
  UtimeCheck check;
  EXPECT_EQ(check.refusal(100), "");
  EXPECT_THAT(check.refusal(99), HasSubstr("utime 99 us after 100 us: time goes backwards"));
  EXPECT_THAT(check.refusal(100), HasSubstr("stands still"));
  EXPECT_EQ(check.refusal(101), "") << "a refused time changes nothing";
}

TEST(UtimeCheck, BeforeTheEpoch) {
  UtimeCheck check;
  EXPECT_THAT(check.refusal(-1), HasSubstr("before 1970"));
  EXPECT_THAT(check.refusal(std::numeric_limits<std::int64_t>::min()), HasSubstr("before 1970"));
}

TEST(UtimeCheck, OneDamagedTimeInTheFutureHarmsNothing) {
  UtimeCheck check;
  EXPECT_EQ(check.refusal(start_us), "");
  EXPECT_THAT(check.refusal(std::numeric_limits<std::int64_t>::max()),
              HasSubstr("jumps by more than an hour"));
  EXPECT_EQ(check.refusal(start_us + frame_us), "");
}

TEST(UtimeCheck, AClockThatWasSetBackIsFollowedAfterAWhile) {
  UtimeCheck check;
  EXPECT_EQ(check.refusal(100'000'000), "");
  int refused = 0;
  for (std::int64_t utime_us = 50'000'000; !check.refusal(utime_us).empty(); utime_us += 33'000) {
    ASSERT_LT(++refused, 30);  // a second of frames
  }
  EXPECT_GT(refused, 5);  // more than stragglers
  EXPECT_EQ(check.refusal(52'000'000), "");
}

TEST(UtimeCheck, AClockThatWasSetBackIsFollowedInASecondFromFiveMessagesASecondOn) {
  for (const std::int64_t per_second : {5, 8, 12, 15, 30, 100}) {
    UtimeCheck check;
    EXPECT_EQ(check.refusal(hour_us + start_us), "");
    std::int64_t utime_us = start_us;
    while (!check.refusal(utime_us).empty()) {
      utime_us += 1'000'000 / per_second;
      ASSERT_LE(utime_us, start_us + 1'000'000) << per_second;
    }
  }
}

TEST(UtimeCheck, StragglersAreNoClockThatWasSetBack) {
  UtimeCheck check;
  EXPECT_EQ(check.refusal(100'000'000), "");
  for (std::int64_t i = 1; i < 100; ++i) {
    EXPECT_NE(check.refusal(99'000'000 + i), "");
    EXPECT_EQ(check.refusal(100'000'000 + i * 33'000), "");
  }
}

TEST(UtimeCheck, AClockThatWasSetIsFollowed) {
  UtimeCheck check;
  EXPECT_EQ(check.refusal(1000), "");  // a robot that woke up in 1970
  EXPECT_NE(check.refusal(start_us), "");
  EXPECT_EQ(check.refusal(start_us + frame_us), "");
  EXPECT_EQ(check.refusal(start_us + 2 * frame_us), "");
}

}  // namespace
}  // namespace gazed::lcm::utime_check_test
