// Decides which frames are published if not all are.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace gazed::daemon {

/// At most this many frames a second, evenly spaced by their own time stamps. A frame counts as due
/// a quarter of an interval early: time stamps jitter, and 15 out of 30 a second must be every
/// other frame.
class ImageRate {
 public:
  /// `per_second`: 0 for all.
  explicit ImageRate(double per_second)
      : interval_us_(per_second > 0.0 ? std::llround(1e6 / per_second) : 0) {}

  /// Whether the frame with this time is published. Starts again if the clock was set back.
  [[nodiscard]] bool is_due(std::int64_t utime_us) {
    const bool first = !next_us_ || utime_us < *next_us_ - 2 * interval_us_;
    if (!first && utime_us < *next_us_ - interval_us_ / 4) return false;
    // From the due time, so that early frames do not add up; after a pause, from now.
    const bool late = first || utime_us > *next_us_ + interval_us_;
    next_us_ = (late ? utime_us : *next_us_) + interval_us_;
    return true;
  }

 private:
  std::int64_t interval_us_;
  std::optional<std::int64_t> next_us_;
};

}  // namespace gazed::daemon
