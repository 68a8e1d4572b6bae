// Head states waiting for the agent, with time stamps assigned on arrival.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "agent/base/ring.hpp"
#include "agent/geometry/head_motion.hpp"

namespace gazed::lola {

/// LoLA's socket does not tell when a state was sent. A state that is read as it arrives gets that
/// time. If several were waiting, only the newest can be younger than a cycle: it gets the current
/// time, and the ones before it get 12 ms less each, LoLA's period, or less where they would
/// otherwise precede a state that was read earlier. The error is below 12 ms and the same for all
/// of them, so differences, and the velocities computed from them, are right.
class HeadQueue {
 public:
  /// Adds one of the states that are being read now. The oldest is dropped if the queue is full.
  void add(const geometry::HeadState& state);
  /// All waiting states have been read: assigns their times.
  void stamp(std::int64_t now_utime_us);
  /// Discards the states that are being read now.
  void discard();
  /// The oldest state; all must have been stamped.
  [[nodiscard]] std::optional<geometry::HeadState> take();

  [[nodiscard]] std::int64_t dropped() const { return dropped_; }

 private:
  [[nodiscard]] geometry::HeadState& from_newest(std::size_t back) {
    return states_[states_.size() - 1 - back];
  }

  // 1.5 s: more than a socket's buffer holds by default (about 90 packets).
  base::Ring<geometry::HeadState, 128> states_;
  std::size_t unstamped_ = 0;  // the newest ones
  std::int64_t last_utime_us_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace gazed::lola
