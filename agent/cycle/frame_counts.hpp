// What became of the frames, for whoever asks why nothing was located.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace gazed::cycle {

/// Each frame that came counts once.
struct FrameCounts {
  std::int64_t looked_at = 0;    // of a still head, when one was wanted
  std::int64_t moving = 0;       // the head was not still
  std::int64_t turning = 0;      // still, but on the way to the next look, or after a fault
  std::int64_t no_angles = 0;    // no head states from before and after its exposure
  std::int64_t other_first = 0;  // while an earlier one waited for its angles
  std::int64_t refused = 0;      // of another size, or of an impossible time

  // Of the times, Unix, microseconds: the earliest and the latest; none where nothing came.
  std::optional<std::int64_t> first_frame_us{}, last_frame_us{}, first_state_us{}, last_state_us{};

  void saw_frame(std::int64_t utime_us) {
    first_frame_us = std::min(utime_us, first_frame_us.value_or(utime_us));
    last_frame_us = std::max(utime_us, last_frame_us.value_or(utime_us));
  }
  void saw_head_state(std::int64_t utime_us) {
    first_state_us = std::min(utime_us, first_state_us.value_or(utime_us));
    last_state_us = std::max(utime_us, last_state_us.value_or(utime_us));
  }
  [[nodiscard]] std::int64_t all() const {
    return looked_at + moving + turning + no_angles + other_first + refused;
  }
};

/// "of 120 frames 100 came while the head moved, 20 were looked at"; and how far frames and head
/// states lie apart where their times do not meet.
[[nodiscard]] std::string in_words(const FrameCounts& counts);

}  // namespace gazed::cycle
