// What the fixation before says of an object, held against what the next one says of it.
//
// A point can be wrong by more than its covariance admits, above all when the object moves along
// the line of sight. The next fixation looks from other places: an error of that kind is another
// one then, and the two contradict each other.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "agent/cycle/fixation.hpp"
#include "agent/geometry/rig.hpp"

namespace gazed::cycle {

class EarlierFixation {
 public:
  explicit EarlierFixation(const geometry::Uncertainty& uncertainty) : uncertainty_(uncertainty) {}

  /// Holds a fixation against the one before, in whose place it is kept then. One that is LOCATED
  /// and contradicts it becomes UNCERTAIN, and its reason says by how much: by direction and
  /// inverse range, their covariances, and how far a standing robot's torso may have moved
  /// meanwhile (chi-square, 99.9 %). The object must be the same: within a moment, its direction
  /// within the outline of before. Errors that both have in common count twice, on the safe side.
  void hold_against(Fixation& fixation);

 private:
  struct Point {
    std::int32_t number = 0;
    std::int64_t utime_us = 0;  // of the last view
    Eigen::Vector3d torso_m;
    Eigen::Matrix3d covariance_m2;
    double radius_rad = 0.0;  // of the object, as it was seen
  };

  [[nodiscard]] static std::optional<Point> point_of(const Fixation& fixation);

  geometry::Uncertainty uncertainty_;
  std::optional<Point> earlier_;
};

}  // namespace gazed::cycle
