#include "drivers/naoqi/robot_clock.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace gazed::naoqi {

std::optional<std::int64_t> RobotClock::here_us(std::int64_t stamp_us, std::int64_t now_us) {
  const std::int64_t difference_us = now_us - stamp_us;
  if (least_ && std::abs(difference_us - *least_) > apart_us) {
    const auto last = std::exchange(apart_, difference_us);
    if (!last || std::abs(difference_us - *last) > apart_us) return std::nullopt;
    least_ = least_before_ = std::nullopt;
  }
  apart_.reset();
  if (!least_ || now_us >= window_ends_us_ || now_us < window_ends_us_ - window_us) {
    least_before_ = std::exchange(least_, difference_us);
    window_ends_us_ = now_us + window_us;
  }
  least_ = std::min(*least_, difference_us);
  return stamp_us + std::min(*least_, least_before_.value_or(*least_));
}

}  // namespace gazed::naoqi
