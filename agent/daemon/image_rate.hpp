// Which frames are published when not all are.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace gazed::daemon {

/// At most so many frames a second, by their own times, evenly. A frame counts as due a quarter of
/// the interval early: a camera's times jitter, and every second frame of 30 a second is to be 15.
class ImageRate {
 public:
  /// `per_second`: 0 for all.
  explicit ImageRate(double per_second)
      : interval_us_(per_second > 0.0 ? std::llround(1e6 / per_second) : 0) {}

  /// Whether the frame of that time is published. A clock that was set back begins anew.
  [[nodiscard]] bool is_due(std::int64_t utime_us) {
    const bool first = !next_us_ || utime_us < *next_us_ - 2 * interval_us_;
    if (!first && utime_us < *next_us_ - interval_us_ / 4) return false;
    // From when it was due, so that early ones do not add up; after a pause from now.
    const bool late = first || utime_us > *next_us_ + interval_us_;
    next_us_ = (late ? utime_us : *next_us_) + interval_us_;
    return true;
  }

 private:
  std::int64_t interval_us_;
  std::optional<std::int64_t> next_us_;
};

}  // namespace gazed::daemon
