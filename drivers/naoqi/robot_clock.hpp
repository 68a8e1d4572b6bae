// Converts another computer's time stamps to this computer's time.
#pragma once

#include <cstdint>
#include <optional>

namespace gazed::naoqi {

/// The clocks' difference is estimated from the stamp of the last 5 to 10 s that arrived with the
/// least delay: delays are positive, and the smallest of many is nearly constant. It remains part
/// of the difference. If the other clock is set by more than 1 s, this is accepted when a second
/// stamp agrees with the first, which may just have arrived late.
class RobotClock {
 public:
  /// Converts `stamp_us`, which has just arrived. None for a stamp more than 1 s from what the
  /// previous ones predict.
  [[nodiscard]] std::optional<std::int64_t> here_us(std::int64_t stamp_us, std::int64_t now_us);

 private:
  static constexpr std::int64_t window_us = 5'000'000;
  static constexpr std::int64_t apart_us = 1'000'000;

  std::optional<std::int64_t> least_, least_before_;  // of this window and the previous one
  std::optional<std::int64_t> apart_;                 // of the last stamp, if it did not agree
  std::int64_t window_ends_us_ = 0;
};

}  // namespace gazed::naoqi
