// Decides whether the object is a ball, and corrects the depth of its outline to that of its
// centre.
//
// The outline of a ball is the circle where the viewing rays touch it. That circle is nearer than
// the centre by radius^2 / distance, and the outline moves with the camera as that circle does: to
// first order in the baseline, to any order in the radius. A disc that faces the camera has the
// same outline at its own depth. Two cues tell them apart:
//
// - The inside of the outline. On a ball, a pattern or shading stands out by the radius, a mirrored
//   lamp by half of it (Relief); on a flat object nothing does.
// - The slopes of the outline, to second order in the baseline. A disc keeps its plane. A ball is
//   round from every side: if D is the distance and t the translation from camera 1 to camera 2
//   across the line of sight, its outline seems to have the slope t / (2 D^2) (inverse depth by
//   angle) against the plane that faces camera 1.
#pragma once

#include <Eigen/Core>

#include "agent/tracking/refine.hpp"
#include "agent/tracking/relief.hpp"
#include "agent/tracking/warp.hpp"

namespace gazed::tracking {

class BelievedBall {
 public:
  /// Starts a new target.
  void begin(const Relief& relief);

  /// Adds the evidence of one look.
  void see(const WarpFit& fit, const PatchMotion& motion);

  /// Probability that the object is a ball, 0 to 1; about 0.2 without evidence.
  [[nodiscard]] double probability() const;

  /// Expected correction of the inverse depth, relative to it: the centre is farther than the
  /// outline.
  [[nodiscard]] double centre_correction() const { return probability() * square(); }
  /// Standard deviation of the correction; its error is the same in every look.
  [[nodiscard]] double centre_correction_sigma() const;

 private:
  [[nodiscard]] double square() const { return relief_.radius_rad() * relief_.radius_rad(); }
  void see_relief(const WarpFit& fit);
  void see_slopes(const WarpFit& fit, const PatchMotion& motion);
  [[nodiscard]] double log_odds_by_relief() const;
  [[nodiscard]] double log_odds_by_slopes() const;

  Relief relief_;
  // Over all looks: the relief in radii; its information, and the sum of values weighted by
  // information.
  double relief_information_ = 0.0, relief_sum_ = 0.0;
  /// Slopes against the plane that faces camera 1, 1/m, up to an unknown slope common to all looks.
  class SameInAllLooks {
   public:
    void add(const Eigen::Vector2d& value, const Eigen::Matrix2d& information);
    /// The residual when the common slope takes its most likely value.
    [[nodiscard]] double chi2(double sigma) const;

   private:
    Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
    Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
    double squares_ = 0.0;
  };
  SameInAllLooks flat_, ball_;  // residual slopes if the object is flat, and if it is a ball
  double inverse_distance_per_m_ = 0.0;
};

}  // namespace gazed::tracking
