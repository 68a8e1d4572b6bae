// Where the head may go: joint ranges, the pitch range that narrows with yaw (the shell must not
// hit the shoulders), a margin.
#pragma once

#include <span>

#include "agent/geometry/head.hpp"

namespace gazed::geometry {

struct AngleRange {
  double min_rad = 0.0;
  double max_rad = 0.0;

  [[nodiscard]] bool contains(double angle_rad) const {
    return angle_rad >= min_rad && angle_rad <= max_rad;
  }
};

/// The largest margin. At the narrowest place (yaw 1.527 rad) the pitch range is 0.530 rad wide:
/// less this on both sides it still holds a step of 0.1 rad up or down from everywhere.
inline constexpr double max_margin_rad = 0.15;

/// The NAO's limits (the manufacturer's joint page and anti-collision table), the same in V3.2 to
/// V6, shrunk by a margin on every side.
class HeadLimits {
 public:
  /// margin_rad in [0, max_margin_rad]; throws std::invalid_argument outside.
  explicit HeadLimits(double margin_rad = 0.0);

  [[nodiscard]] double margin_rad() const { return margin_rad_; }
  [[nodiscard]] AngleRange yaw_range() const;
  /// Pitch range at a yaw; beyond the last row of the table, that row's.
  [[nodiscard]] AngleRange pitch_range(double yaw_rad) const;
  [[nodiscard]] bool contains(HeadAngles angles) const;
  /// True when the whole straight segment in (yaw, pitch) stays inside: its ends and the table's
  /// break yaws (to 1e-12 rad, the rounding of the interpolation) decide, since between these the
  /// allowed region is convex.
  [[nodiscard]] bool contains_segment(HeadAngles from, HeadAngles to) const;
  /// The yaws of the table's rows, ascending: between two of them the pitch limits are linear (but
  /// for the tip at yaw 0, which the joint range cuts off: still convex).
  [[nodiscard]] static std::span<const double> break_yaws_rad();
  /// The nearest allowed angles, yaw first, then pitch at that yaw.
  [[nodiscard]] HeadAngles clamp(HeadAngles angles) const;

 private:
  double margin_rad_;
};

}  // namespace gazed::geometry
