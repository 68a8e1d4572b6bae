// Checks whether frames and head states are stamped by clocks that agree.
//
// Offset: how much later than the last head state a frame is stamped, minus the time between their
// arrivals. If the clocks agree, this is the camera's negative latency.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace gazed::daemon {

class ClockComparison {
 public:
  /// `now_s`: time of arrival, by a clock that never goes back.
  void saw_head_state(std::int64_t utime_us, double now_s);
  /// `kept_s`: how long the head's angles are kept; older frames find none.
  void saw_frame(std::int64_t utime_us, double now_s, double kept_s);

  /// How far the clocks differ or frames are late, and whether the difference is constant or a
  /// wrong unit; empty while they agree. The text does not change while the fault lasts.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// That the clocks drift apart, reported once; otherwise empty.
  [[nodiscard]] std::string warning() { return std::exchange(warning_, {}); }

 private:
  /// Consecutive frames with a wrong offset.
  struct Run {
    int frames = 0;
    double begin_s = 0.0;
    double least_s = 0.0, greatest_s = 0.0;  // offsets
  };

  void watch_drift(double offset_s, double now_s);
  void notice_set_back(std::int64_t utime_us, std::int64_t before_us, double now_s);

  std::int64_t head_utime_us_ = 0, frame_utime_us_ = 0;
  double head_came_s_ = 0.0;
  bool head_came_ = false, frame_came_ = false;
  double set_back_s_ = -INFINITY;  // when a clock was last set back
  Run apart_;
  std::string fault_;
  // Of the offset, which late frames reduce: the largest in the current stretch of time and in the
  // first one.
  double stretch_begin_s_ = -1.0, stretch_greatest_s_ = 0.0;
  double first_begin_s_ = -1.0, first_greatest_s_ = 0.0;
  bool drift_reported_ = false;
  std::string warning_;
};

}  // namespace gazed::daemon
