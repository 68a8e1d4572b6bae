// Head states that wait for the agent, with the times that they get on arrival.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "agent/base/ring.hpp"
#include "agent/geometry/head_motion.hpp"

namespace gazed::lola {

/// States come by a socket that does not say when they were sent. One that is read when it arrives
/// has that time. Of several that were waiting only the newest can be younger than a cycle: it
/// counts as of now, those before it 12 ms earlier each, as LoLA measured them; closer together
/// where the last one that was read before them would be overtaken. So the error is one of the
/// newest's own, below 12 ms, and the same for all: differences, from which the velocity is taken,
/// are right.
class HeadQueue {
 public:
  /// One more of those that are being read now. The oldest is dropped when the queue is full.
  void add(const geometry::HeadState& state);
  /// All have been read that were there: they get their times.
  void stamp(std::int64_t now_utime_us);
  /// Those that are being read now shall not be handed on.
  void discard();
  /// The oldest; all must have been stamped.
  [[nodiscard]] std::optional<geometry::HeadState> take();

  [[nodiscard]] std::int64_t dropped() const { return dropped_; }

 private:
  [[nodiscard]] geometry::HeadState& from_newest(std::size_t back) {
    return states_[states_.size() - 1 - back];
  }

  // 1.5 s: more than a socket's buffer holds by default (90 packets or so).
  base::Ring<geometry::HeadState, 128> states_;
  std::size_t unstamped_ = 0;  // the newest ones
  std::int64_t last_utime_us_ = 0;
  std::int64_t dropped_ = 0;
};

}  // namespace gazed::lola
