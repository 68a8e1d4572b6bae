// Compares a fixation with the previous one at the same object.
//
// A point can be wrong by more than its covariance admits, above all if the object moves along the
// line of sight. The next fixation looks from other places, so such an error changes, and the two
// contradict each other.
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

  /// Compares a fixation with the previous one, and replaces that by it. If it is LOCATED and
  /// contradicts the previous one, it becomes UNCERTAIN and its reason says by how much. The
  /// comparison uses direction and inverse range, their covariances, and how far a standing robot's
  /// torso may have moved meanwhile (chi-square, 99.9 %). It is only made for the same object:
  /// within a moment, and with the direction inside the previous outline. Errors that both have in
  /// common are counted twice, which is conservative.
  void hold_against(Fixation& fixation);

 private:
  struct Point {
    std::int32_t number = 0;
    std::int64_t utime_us = 0;  // of the last view
    Eigen::Vector3d torso_m;
    Eigen::Matrix3d covariance_m2;
    double radius_rad = 0.0;  // angular radius of the object
  };

  [[nodiscard]] static std::optional<Point> point_of(const Fixation& fixation);

  geometry::Uncertainty uncertainty_;
  std::optional<Point> earlier_;
};

}  // namespace gazed::cycle
