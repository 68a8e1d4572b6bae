// Bundle adjustment over the kinematic chain: the parameters of a head, the angles of each look and
// what was seen, fitted together to the pixels by robust least squares with priors.
//
// Look: one still position of the head, its measured angles, a picture. Pattern: points whose
// coordinates are known in a frame of their own (a chessboard, measured marks), and whose frame
// stands still somewhere. Scene: points that nobody knows; each is a direction from the neck and an
// inverse range along it, so that far ones are no special case (Civera, Davison, Montiel 2008).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "agent/geometry/head.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/lab/calibration/parameters.hpp"

namespace gazed::lab::calibration {

struct PointSighting {
  int look = 0;
  int point = 0;
  geometry::Pixel pixel = geometry::Pixel::Zero();
};

struct BundleInput {
  std::vector<geometry::HeadAngles> looks;  // as measured
  std::vector<PointSighting> sightings;
  int point_count = 0;
  /// Of a pattern, point_count of them; empty for a scene.
  std::vector<Eigen::Vector3d> pattern_m;
  /// Where the pattern's frame is believed to stand; needed with a pattern.
  geometry::Pose neck_from_pattern;
  bool pattern_held = false;  // its place is known, not estimated

  Prior prior;
  double encoder_sigma_rad = 0.0;  // of each look and axis; 0: the angles are what was measured
  double pixel_sigma_px = 0.0;     // a first guess; the residuals decide
  /// What agrees with nothing is left out; else every sighting counts, if less the farther it is
  /// off.
  bool outliers_rejected = true;
};

struct ResidualRms {
  double measured_px = 0.0;  // with the looks' angles as measured
  double refined_px = 0.0;   // with the angles that fit best within the encoders' noise
};

struct BundleResult {
  bool converged = false;
  Parameters estimate = Parameters::Zero();
  ResidualRms before, after;  // rms of the pixel coordinates that were used; what was seen is
                              // fitted in both
  std::vector<geometry::HeadAngles> looks;  // refined
  geometry::Pose neck_from_pattern;
  std::size_t sightings_used = 0;  // those left out agree with nothing (5 sigma)
  double pixel_sigma_px = 0.0;     // that the residuals show
  double encoder_sigma_rad = 0.0;  // that the looks' corrections show
  /// What the pixels tell about the free parameters, all else eliminated; without the prior. In the
  /// order of Prior::free_indices().
  Eigen::MatrixXd information;
};

/// Throws std::invalid_argument when there is less to fit than there are unknowns.
[[nodiscard]] BundleResult adjust_bundle(const BundleInput& input);

}  // namespace gazed::lab::calibration
