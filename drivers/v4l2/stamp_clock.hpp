// Which clock a buffer was stamped by, and what that is in Unix time.
//
// Linux since 3.10 tells in the buffer's flags, and nearly every driver stamps by CLOCK_MONOTONIC.
// On the kernel of a NAO V4 or V5 there are no such flags, and drivers stamp by CLOCK_REALTIME
// (B-Human 2017, Platform/Nao/Time.cpp: "video4linux timestamps use this clock").
#pragma once

#include <cstdint>
#include <sys/time.h>

#include "drivers/clocks.hpp"

namespace gazed::v4l2 {

/// Both clocks at one moment.
struct ClockPair {
  std::int64_t realtime_us = 0;
  std::int64_t monotonic_us = 0;
};

/// Of three readings of one clock between two of the other, the one that took least: the pair is
/// right within half of that, microseconds unless the process was interrupted in all three.
[[nodiscard]] ClockPair read_clocks(const drivers::Clocks& clocks);

enum class StampClock : std::uint8_t {
  monotonic,
  realtime,
  none,  // copied from elsewhere, or near neither clock
};

struct StampTime {
  std::int64_t utime_us = 0;  // where there is no clock: now
  StampClock clock = StampClock::none;
};

/// `flags` and `stamp` are a buffer's, `now` read after it came. A stamp belongs to the clock that
/// its flags name, without flags to the clock that it is nearer to; in either case only when it
/// lies in the last hour, or in the next second.
[[nodiscard]] StampTime stamp_time(std::uint32_t flags, const timeval& stamp, const ClockPair& now);

}  // namespace gazed::v4l2
