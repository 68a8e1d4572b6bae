// Whether frames and head states have their times from clocks that agree.
//
// Offset: how much later than the head state that came last a frame is stamped, less the time that
// passed between their arrivals. It is the camera's latency, negative, where the clocks agree.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace gazed::daemon {

class ClockComparison {
 public:
  /// `now_s`: when it came, of a clock that only goes forward.
  void saw_head_state(std::int64_t utime_us, double now_s);
  /// `kept_s`: how long the head's angles are kept; none are found for frames older than that.
  void saw_frame(std::int64_t utime_us, double now_s, double kept_s);

  /// By how much the clocks differ, or frames come late, and whether it is constant or a unit;
  /// empty while they agree. The words stay while it lasts.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// That the clocks drift apart, reported once; empty otherwise.
  [[nodiscard]] std::string warning() { return std::exchange(warning_, {}); }

 private:
  /// Frames in a row that are apart.
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
  // Of the offset, which a frame that comes late lowers: the greatest of a stretch of time, and of
  // the first stretch.
  double stretch_begin_s_ = -1.0, stretch_greatest_s_ = 0.0;
  double first_begin_s_ = -1.0, first_greatest_s_ = 0.0;
  bool drift_reported_ = false;
  std::string warning_;
};

}  // namespace gazed::daemon
