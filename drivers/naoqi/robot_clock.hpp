// Another computer's time stamps in this computer's time.
#pragma once

#include <cstdint>
#include <optional>

namespace gazed::naoqi {

/// The difference of the clocks is taken from the stamp that arrived soonest after it was made, of
/// those of the last 5 to 10 s: all delays are positive, and the least of many is nearly always the
/// same. What is left of it, the fastest way from the camera to here, counts as part of the clocks'
/// difference. A clock that is set, by more than 1 s, is believed when a second stamp agrees with
/// the first: that one alone may just have come late.
class RobotClock {
 public:
  /// What was stamped `stamp_us` arrived now. Nothing for a stamp that is more than 1 s from what
  /// those before it let expect.
  [[nodiscard]] std::optional<std::int64_t> here_us(std::int64_t stamp_us, std::int64_t now_us);

 private:
  static constexpr std::int64_t window_us = 5'000'000;
  static constexpr std::int64_t apart_us = 1'000'000;

  std::optional<std::int64_t> least_, least_before_;  // of this window and the last one
  std::optional<std::int64_t> apart_;                 // the last stamp's, where it did not agree
  std::int64_t window_ends_us_ = 0;
};

}  // namespace gazed::naoqi
