#include "drivers/v4l2/stamp_clock.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <linux/videodev2.h>
#include <vector>

namespace gazed::v4l2::stamp_clock_test {
namespace {

constexpr ClockPair now{1'700'000'000'000'000, 5'000'000'000};
constexpr std::int64_t hour_us = 3'600'000'000;

timeval stamp_of(std::int64_t time_us) {
  timeval stamp{};
  stamp.tv_sec = static_cast<decltype(stamp.tv_sec)>(time_us / 1'000'000);
  stamp.tv_usec = static_cast<decltype(stamp.tv_usec)>(time_us % 1'000'000);
  return stamp;
}

StampTime of(std::uint32_t flags, std::int64_t stamp_us, const ClockPair& clocks = now) {
  return stamp_time(flags, stamp_of(stamp_us), clocks);
}

void expect(const StampTime& found, StampClock clock, std::int64_t utime_us) {
  EXPECT_EQ(found.clock, clock);
  EXPECT_EQ(found.utime_us, utime_us);
}

TEST(StampClock, MonotonicStampsAreTurnedIntoUnixTime) {
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, now.monotonic_us - 20'000), StampClock::monotonic,
         now.realtime_us - 20'000);
}

TEST(StampClock, AFrameMayBeStampedWithItsEndToCome) {
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, now.monotonic_us + 36'000), StampClock::monotonic,
         now.realtime_us + 36'000);
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, now.realtime_us + 36'000), StampClock::realtime,
         now.realtime_us + 36'000);
}

TEST(StampClock, UnknownStampsAreOfTheClockThatTheyAreNearTo) {
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, now.realtime_us - 20'000), StampClock::realtime,
         now.realtime_us - 20'000);
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, now.monotonic_us - 20'000), StampClock::monotonic,
         now.realtime_us - 20'000);
}

TEST(StampClock, ARobotWithoutABatteryForItsClockHasBothClocksNearTogether) {
  // Started in 1970: the wall clock is 12 s ahead.
  const ClockPair young{72'000'000, 60'000'000};
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, 71'980'000, young), StampClock::realtime, 71'980'000);
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, 59'980'000, young), StampClock::monotonic, 71'980'000);
  // The same clock twice: either is right.
  EXPECT_EQ(of(V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN, 59'980'000, {60'000'000, 60'000'000}).utime_us,
            59'980'000);
}

TEST(StampClock, CopiedStampsAreOfNoClock) {
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_COPY, now.realtime_us), StampClock::none, now.realtime_us);
}

TEST(StampClock, WhatLiesInNoRecentTimeIsOfNoClock) {
  for (const std::uint32_t flags :
       {V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN}) {
    for (const std::int64_t stamp_us :
         {std::int64_t{0}, now.monotonic_us - hour_us - 1, now.monotonic_us + 1'000'001,
          std::int64_t{1} << 50, std::int64_t{-1'000'000}}) {
      expect(of(flags, stamp_us), StampClock::none, now.realtime_us);
    }
  }
  // What the flags say counts, wherever the stamp is.
  expect(of(V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, now.realtime_us - 20'000), StampClock::none,
         now.realtime_us);
}

TEST(StampClock, EveryStampIsAnswered) {
  using Seconds = decltype(timeval::tv_sec);
  for (const Seconds seconds : {std::numeric_limits<Seconds>::min(), Seconds{-1}, Seconds{0},
                                std::numeric_limits<Seconds>::max()}) {
    timeval stamp{};
    stamp.tv_sec = seconds;
    stamp.tv_usec = 999'999;
    for (const std::uint32_t flags : {0U, 0x2000U, 0x4000U, 0xFFFFFFFFU})
      EXPECT_EQ(stamp_time(flags, stamp, now).clock, StampClock::none) << seconds;
  }
}

TEST(StampClock, TheTightestOfThreeReadingsCounts) {
  // The process is interrupted in the first reading and, less, in the last.
  const std::vector<std::int64_t> monotonic{1'000, 51'000, 60'000, 60'004, 70'000, 70'100};
  const std::vector<std::int64_t> realtime{900'000, 960'002, 970'050};
  std::size_t m = 0, r = 0;
  const ClockPair pair = read_clocks({.monotonic_us = [&] { return monotonic.at(m++); },
                                      .realtime_us = [&] { return realtime.at(r++); }});
  EXPECT_EQ(pair.realtime_us, 960'002);
  EXPECT_EQ(pair.monotonic_us, 60'002);
}

}  // namespace
}  // namespace gazed::v4l2::stamp_clock_test
