// Whether the object is a ball, and where its centre is then.
//
// Of a ball a look sees no more than the circle in which its rays touch it. That circle is nearer
// than the centre by the square of the radius over the distance, and its outline moves with the
// camera as the circle does: to first order in the baseline, to any order in the radius. A disc
// that faces the camera has the same outline, at its own depth. Two things tell them apart:
//
// - What is inside the outline. A ball's pattern or shading stands out by the radius, a mirrored
//   lamp by half of it (Relief), what is on a flat thing not at all.
// - The outline's slopes, to second order in the baseline. A disc keeps its plane. A ball is round
//   from wherever it is looked at: with D the distance and t the shift across the line of sight
//   that takes points of camera 1 to camera 2, its outline seems to have the slope t / (2 D^2), in
//   inverse depth by angle, against the plane that faces camera 1.
#pragma once

#include <Eigen/Core>

#include "agent/tracking/refine.hpp"
#include "agent/tracking/relief.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

class BelievedBall {
 public:
  /// A new target.
  void begin(const Relief& relief);

  /// What a look has found.
  void see(const WarpFit& fit, const PatchMotion& motion);

  /// A fifth where nothing tells.
  [[nodiscard]] double probability() const;

  /// By which the centre is farther than the outline, of the inverse depth, as expected.
  [[nodiscard]] double share() const { return probability() * square(); }
  /// Its standard deviation, in every look the same.
  [[nodiscard]] double share_sigma() const;

 private:
  [[nodiscard]] double square() const { return relief_.radius_rad() * relief_.radius_rad(); }
  void see_relief(const WarpFit& fit);
  void see_slopes(const WarpFit& fit, const PatchMotion& motion);
  [[nodiscard]] double log_odds_by_relief() const;
  [[nodiscard]] double log_odds_by_slopes() const;

  Relief relief_;
  // From all looks: the relief in radii, its information and the sum of values by information.
  double relief_information_ = 0.0, relief_sum_ = 0.0;
  /// Slopes against the plane that faces camera 1, 1/m, but for some that are the same in all
  /// looks.
  class SameInAllLooks {
   public:
    void add(const Eigen::Vector2d& value, const Eigen::Matrix2d& information);
    /// What is left when the value that is the same in all is as likely as it gets.
    [[nodiscard]] double chi2(double sigma) const;

   private:
    Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
    Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
    double squares_ = 0.0;
  };
  SameInAllLooks flat_, ball_;  // by which they are not a flat thing's, and not a ball's
  double inverse_distance_per_m_ = 0.0;
};

}  // namespace gazed::tracking
