// Where the head is told to be next, on its way to a target: never outside the table of limits, and
// never faster than its motors.
#pragma once

#include <cstdint>

#include "agent/geometry/head.hpp"

namespace gazed::lola {

class SetPoint {
 public:
  /// The nearest allowed place to where the head is, at rest.
  void start(geometry::HeadAngles measured);

  /// One order further towards `target`, on a straight way so that both joints arrive together; at
  /// the edge of the limits along it. Gathers speed and brakes, also along the old way before it
  /// takes a new one, and goes at most at `speed_fraction` (0 to 1) of each joint's greatest speed
  /// (braking down to it, where it is told in between). `elapsed_us` is the time since the
  /// last order; more than one cycle of LoLA counts as one: an order that comes late moves the head
  /// no faster. The target must be finite. True when it, or the allowed place nearest to it, is
  /// reached.
  bool step(geometry::HeadAngles target, double speed_fraction, std::int64_t elapsed_us);
  /// To where the head is, as fast as its joints can be moved: its motors push nothing.
  void follow(geometry::HeadAngles measured, std::int64_t elapsed_us);

  /// Stays where it is; the next step starts from rest.
  void stop() { speed_ = 0.0; }

  [[nodiscard]] geometry::HeadAngles angles() const { return angles_; }

 private:
  /// Moves on for so long at so much of the greatest speed. True when `target` is reached.
  bool advance(geometry::HeadAngles target, double speed_fraction, double seconds);

  geometry::HeadAngles angles_;
  geometry::HeadAngles heading_;  // the last step's direction: rad/s at the greatest speed
  double speed_ = 0.0;            // of the greatest
};

}  // namespace gazed::lola
