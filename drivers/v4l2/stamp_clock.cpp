#include "drivers/v4l2/stamp_clock.hpp"

#include <cstdlib>
#include <limits>
#include <linux/videodev2.h>

namespace gazed::v4l2 {

namespace {

// A frame waits while the process is stopped, but not that long; and the two clocks are decades
// apart, but for a robot without a battery for its clock.
constexpr std::int64_t oldest_us = 3'600'000'000;
// A driver may stamp a frame with the time when it will have ended (vivid: up to a frame ahead).
constexpr std::int64_t ahead_us = 1'000'000;

std::int64_t microseconds(const timeval& stamp) {
  // 32 bits of seconds are read without a sign, which is right until 2106.
  const std::int64_t seconds =
      sizeof(stamp.tv_sec) == 4
          ? static_cast<std::int64_t>(static_cast<std::uint32_t>(stamp.tv_sec))
          : static_cast<std::int64_t>(stamp.tv_sec);
  // Seconds that no clock shows would overflow.
  if (seconds < 0 || seconds > (std::int64_t{1} << 40)) return -1;
  return 1'000'000 * seconds + stamp.tv_usec;
}

}  // namespace

ClockPair read_clocks(const drivers::Clocks& clocks) {
  constexpr int readings = 3;
  ClockPair best;
  std::int64_t least_us = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < readings; ++i) {
    const std::int64_t before_us = clocks.monotonic_us();
    const std::int64_t realtime_us = clocks.realtime_us();
    const std::int64_t took_us = clocks.monotonic_us() - before_us;
    if (took_us >= least_us) continue;
    least_us = took_us;
    best = {realtime_us, before_us + took_us / 2};
  }
  return best;
}

StampTime stamp_time(std::uint32_t flags, const timeval& stamp, const ClockPair& now) {
  const std::int64_t stamp_us = microseconds(stamp);
  const std::int64_t monotonic_age_us = now.monotonic_us - stamp_us;
  const std::int64_t realtime_age_us = now.realtime_us - stamp_us;
  const auto is_age = [](std::int64_t age_us) {
    return age_us >= -ahead_us && age_us <= oldest_us;
  };
  const StampTime by_monotonic{now.realtime_us - monotonic_age_us, StampClock::monotonic};
  const StampTime by_realtime{stamp_us, StampClock::realtime};
  const StampTime by_none{now.realtime_us, StampClock::none};
  switch (flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) {
    case V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC:
      return is_age(monotonic_age_us) ? by_monotonic : by_none;
    case V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN: {
      const bool nearer_to_monotonic = std::abs(monotonic_age_us) < std::abs(realtime_age_us);
      if (nearer_to_monotonic) return is_age(monotonic_age_us) ? by_monotonic : by_none;
      return is_age(realtime_age_us) ? by_realtime : by_none;
    }
    default:  // V4L2_BUF_FLAG_TIMESTAMP_COPY: from an output queue, of a time of its own
      return by_none;
  }
}

}  // namespace gazed::v4l2
