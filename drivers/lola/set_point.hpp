// Where the head is told to be next, on its way to a target: never outside the table of limits, and
// never faster than its motors.
#pragma once

#include <cstdint>

#include "agent/geometry/head.hpp"

namespace gazed {

class SetPoint {
 public:
  /// The nearest allowed place to where the head is.
  void start(HeadAngles measured);
  /// One order further towards `target`, on a straight way so that both joints arrive together; at
  /// the edge of the limits along it. As far as `speed_fraction` (0 to 1) of each joint's greatest
  /// speed takes it in `elapsed_us`, at most in one cycle of LoLA: an order that comes late moves
  /// the head no faster. The target must be finite. True when it, or the allowed place nearest to
  /// it, is reached.
  bool step(HeadAngles target, double speed_fraction, std::int64_t elapsed_us);

  [[nodiscard]] HeadAngles angles() const { return angles_; }

 private:
  HeadAngles angles_;
};

/// Each joint's way in one cycle at its greatest speed.
[[nodiscard]] HeadAngles greatest_step();

}  // namespace gazed
