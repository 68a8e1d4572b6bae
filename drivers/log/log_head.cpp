#include "drivers/log/log_head.hpp"

namespace gazed::log {

LogHead::LogHead(const std::string& path, const lcm::Channels& channels)
    : playback_(path, channels.head_state, lcm::HeadStateIntake(channels.head_state)) {}

std::optional<std::int64_t> LogHead::next_utime_us() {
  return playback_.due_us();
}

std::optional<geometry::HeadState> LogHead::next_state() {
  const std::optional<geometry::HeadState> state = playback_.intake().next_state();
  if (state) playback_.advance();
  return state;
}

}  // namespace gazed::log
