#include "agent/lab/live/frame_rate.hpp"

namespace gazed::lab::live {

void FrameRate::saw(double now_s) {
  times_s_.push(now_s);
}

double FrameRate::per_second() const {
  if (times_s_.size() < 2) return 0.0;
  const double passed_s = times_s_.newest() - times_s_.oldest();
  return passed_s > 0.0 ? static_cast<double>(times_s_.size() - 1) / passed_s : 0.0;
}

}  // namespace gazed::lab::live
