// How many frames come a second, now.
#pragma once

#include <cstddef>

#include "agent/base/ring.hpp"

namespace gazed::lab::live {

class FrameRate {
 public:
  /// Seconds of a clock that only goes forward.
  void saw(double now_s);
  /// Over the newest frames, 30 at most; 0 before the second one.
  [[nodiscard]] double per_second() const;

 private:
  static constexpr std::size_t newest = 30;  // a second of most cameras
  base::Ring<double, newest + 1> times_s_;
};

}  // namespace gazed::lab::live
