#include "drivers/lcm/gap_counter.hpp"

#include <algorithm>

namespace gazed::lcm {

namespace {

constexpr std::size_t fewest_intervals = 3;  // to know what is usual
constexpr std::int64_t longest_gap = 100;    // intervals

}  // namespace

std::int64_t GapCounter::usual_interval_us() const {
  auto sorted = intervals_us_;
  const std::size_t count = std::min(seen_, sorted.size());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

void GapCounter::saw(std::int64_t utime_us) {
  if (last_us_) {
    const std::int64_t interval_us = utime_us - *last_us_;
    if (seen_ >= fewest_intervals) {
      const std::int64_t usual_us = usual_interval_us();
      const std::int64_t frames = (interval_us + usual_us / 2) / usual_us;  // rounded
      if (frames > 1) missing_ += frames > longest_gap ? 1 : static_cast<std::int32_t>(frames - 1);
    }
    intervals_us_[seen_++ % intervals_us_.size()] = interval_us;
  }
  last_us_ = utime_us;
}

}  // namespace gazed::lcm
