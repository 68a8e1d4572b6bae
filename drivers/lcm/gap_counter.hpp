// Counts frames that never came, from the times of those that did.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace gazed::lcm {

/// A camera's frames come at a steady rate, so an interval of about n times the usual one hides n-1
/// frames. The usual interval is the median of the last nine, which follows a changed rate after
/// five frames.
class GapCounter {
 public:
  /// A frame of time `utime_us`, later than the one before.
  void saw(std::int64_t utime_us);

  /// Frames that did not come so far. A silence of more than 100 intervals counts as one: the
  /// camera was stopped.
  [[nodiscard]] std::int32_t missing() const { return missing_; }

 private:
  [[nodiscard]] std::int64_t usual_interval_us() const;

  std::optional<std::int64_t> last_us_;
  std::array<std::int64_t, 9> intervals_us_{};  // ring
  std::size_t seen_ = 0;                        // intervals so far
  std::int32_t missing_ = 0;
};

}  // namespace gazed::lcm
