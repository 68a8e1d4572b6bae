// Times that a source gives must go forward.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace gazed::lcm {

/// Tells usable times from unusable ones.
///
/// One message with a damaged time far in the future would make every later one look late, so a
/// jump of more than an hour is believed only when the message after it goes on from there. Late
/// messages are believed when so many came in a row, each after the one before, or a few over so
/// long, that the sender's clock must have been set back.
class UtimeCheck {
 public:
  /// Empty when `utime_us` comes after the last time that was accepted, else why it is not used.
  [[nodiscard]] std::string refusal(std::int64_t utime_us);
  /// How far the sender's clock was set back so far: added to the times accepted, they never go
  /// back.
  [[nodiscard]] std::int64_t set_back_us() const { return set_back_us_; }

 private:
  /// Under a second of frames or joint samples; stragglers on a network come by ones and twos.
  static constexpr int late_run_believed = 20;
  /// At ten messages a second, and fewer, that would take longer than silence is tolerated (2 s).
  static constexpr int slow_late_run_believed = 5;
  static constexpr std::int64_t slow_late_run_us = 750'000;
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::min();
  std::int64_t newest_us_ = none;  // accepted
  std::int64_t jumped_to_us_ = none;
  std::int64_t late_us_ = none;        // the last of a run of late messages
  std::int64_t first_late_us_ = none;  // of that run
  int late_run_ = 0;
  std::int64_t set_back_us_ = 0;
};

}  // namespace gazed::lcm
