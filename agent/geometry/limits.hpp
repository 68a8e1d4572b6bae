// Where the head may go: joint ranges, the pitch range that narrows with yaw (the shell must not
// hit the shoulders), a margin.
#pragma once

#include <span>

#include "agent/geometry/head.hpp"

namespace gazed {

struct AngleRange {
  double min_rad = 0.0;
  double max_rad = 0.0;

  [[nodiscard]] bool contains(double angle_rad) const {
    return angle_rad >= min_rad && angle_rad <= max_rad;
  }
};

/// The NAO's limits (NAO.md 1.2: the manufacturer's joint page and anti-collision table), the same
/// in V3.2 to V6, shrunk by a margin on every side.
class HeadLimits {
 public:
  /// margin_rad in [0, 0.2]; throws std::invalid_argument outside.
  explicit HeadLimits(double margin_rad = 0.0);

  [[nodiscard]] double margin_rad() const { return margin_rad_; }
  [[nodiscard]] AngleRange yaw_range() const;
  /// Pitch range at a yaw; beyond the last row of the table, that row's.
  [[nodiscard]] AngleRange pitch_range(double yaw_rad) const;
  [[nodiscard]] bool contains(HeadAngles angles) const;
  /// True when the whole straight segment in (yaw, pitch) stays inside: its ends and the table's
  /// break yaws decide, since the limits are linear between them.
  [[nodiscard]] bool contains_segment(HeadAngles from, HeadAngles to) const;
  /// The yaws between which the pitch limits are linear, ascending.
  [[nodiscard]] static std::span<const double> break_yaws_rad();
  /// The nearest allowed angles, yaw first, then pitch at that yaw.
  [[nodiscard]] HeadAngles clamp(HeadAngles angles) const;

 private:
  double margin_rad_;
};

}  // namespace gazed
