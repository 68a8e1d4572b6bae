#include "drivers/lola/head_queue.hpp"

#include <algorithm>

#include "drivers/lola/body.hpp"

namespace gazed::lola {

void HeadQueue::add(const geometry::HeadState& state) {
  if (states_.push(state)) ++dropped_;
  unstamped_ = std::min(unstamped_ + 1, states_.size());
}

void HeadQueue::stamp(std::int64_t now_utime_us) {
  if (unstamped_ == 0) return;
  const std::int64_t since_last_us = now_utime_us - last_utime_us_;
  // If the wall clock was set back there is no room; space the states as if nothing had come
  // before.
  const std::int64_t spacing_us =
      since_last_us > 0
          ? std::min(lola_cycle_us, since_last_us / static_cast<std::int64_t>(unstamped_))
          : lola_cycle_us;
  for (std::size_t back = 0; back < unstamped_; ++back)
    from_newest(back).utime_us = now_utime_us - spacing_us * static_cast<std::int64_t>(back);
  unstamped_ = 0;
  last_utime_us_ = now_utime_us;
}

void HeadQueue::discard() {
  states_.drop_newest(unstamped_);
  unstamped_ = 0;
}

std::optional<geometry::HeadState> HeadQueue::take() {
  if (states_.empty()) return std::nullopt;
  return states_.take();
}

}  // namespace gazed::lola
