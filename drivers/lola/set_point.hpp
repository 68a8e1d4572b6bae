// The head's next set point on the way to a target: never outside the table of limits, never faster
// than the motors.
#pragma once

#include <cstdint>

#include "agent/geometry/head.hpp"

namespace gazed::lola {

class SetPoint {
 public:
  /// Starts at rest, at the allowed place nearest to the head.
  void start(geometry::HeadAngles measured);

  /// One order further towards `target`, on a straight path so that both joints arrive together, or
  /// along the edge of the limits. Accelerates and brakes, and brakes on the old path before taking
  /// a new one. The speed is at most `speed_fraction` (0 to 1) of each joint's maximum; if that is
  /// reduced on the way, it brakes down to it. `elapsed_us` is the time since the last order; more
  /// than one of LoLA's cycles counts as one, so that a late order does not move the head faster.
  /// The target must be finite. Returns true once it, or the nearest allowed place, is reached.
  bool step(geometry::HeadAngles target, double speed_fraction, std::int64_t elapsed_us);
  /// Moves the set point to where the head is, as fast as its joints can be moved, so that the
  /// motors do not push.
  void follow(geometry::HeadAngles measured, std::int64_t elapsed_us);

  /// Stays where it is; the next step starts from rest.
  void stop() { speed_ = 0.0; }

  [[nodiscard]] geometry::HeadAngles angles() const { return angles_; }

 private:
  /// Advances for this long at this fraction of the maximum speed. Returns true if `target` is
  /// reached.
  bool advance(geometry::HeadAngles target, double speed_fraction, double seconds);

  geometry::HeadAngles angles_;
  geometry::HeadAngles heading_;  // direction of the last step: rad/s at the maximum speed
  double speed_ = 0.0;            // as a fraction of the maximum
};

}  // namespace gazed::lola
