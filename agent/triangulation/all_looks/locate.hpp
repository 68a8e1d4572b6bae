// All looks at one target as one least-squares problem: where the target is, how the head truly
// stood at every look, and what is believed of the robot's calibration, from the target's and the
// background's image points.
//
// Unknown: the target's ray in look 1 and its inverse range; a ray and an inverse depth of every
// background feature; two angles of every look, with the encoders' readings as prior; focal length,
// principal point, mount offset, mount rotation and joint zeros, with their sigmas as prior. A
// background point's depth is never assumed: it is an unknown that is eliminated. The covariance of
// the answer is that of the whole problem, so what the looks have in common is never averaged away.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "agent/geometry/head.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/triangulation/all_looks/believed_robot.hpp"
#include "agent/triangulation/all_looks/error_budget.hpp"
#include "agent/triangulation/all_looks/look.hpp"
#include "agent/triangulation/feature_observations.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation::all_looks {

/// What the background did for the looks' angles.
enum class Refinement {
  none,       // no features, or too few: the angles are the encoders', improved by the target alone
  used,       // angles and target come from everything together
  distrusted  // the features contradict each other or the encoders: left out
};

struct Estimate {
  /// As of one pair. The reason also names the looks that were not used.
  PointEstimate point;
  std::array<LookVerdict, looks_max> looks;  // as given; the first is used if any is
  ErrorBudget budget;                        // of point.inverse_range_sigma_per_m, squared
  std::size_t looks_used = 0;                // with the first
  double chi2 = not_a_number;                // of the target's image points
  int degrees_of_freedom = 0;                // of the chi-square: two for each later look less one

  Refinement refinement = Refinement::none;
  /// What the sensors should have said, with the zeros that are believed of them.
  std::array<geometry::HeadAngles, looks_max> head;
  /// The same with the zeros that came out, which `robot` has.
  std::array<geometry::HeadAngles, looks_max> reading;
  /// How the torso stood at every look against look 1: the identity where it did not move.
  std::array<geometry::Pose, looks_max> torso_1_from_torso;
  /// After the looks. Its chain at reading[0] takes point.point_m to point.torso_point_m.
  BelievedRobot robot;
  std::size_t features_used = 0;  // seen in at least one later look, and agreeing
  std::size_t features_rejected = 0;
  /// Bit k: its pixel in look k was believed; by feature, as given.
  std::array<std::uint16_t, features_max> feature_used_in{};
  /// Of the inverse range, if the next look is as good as the last one. NaN where none is planned
  /// or where it would not see the target.
  double expected_sigma_per_m = not_a_number;
};

/// Asked once, with all but what is expected: where the next look would go, given what those so far
/// tell; none where nobody wants to know what it would be worth.
using NextLook = std::function<std::optional<geometry::HeadAngles>(const Estimate&)>;

/// The target's pixel in look 1 defines the point and has no noise; those in later looks have
/// Uncertainty::pixel_sigma_px with their registration's covariance on top; a feature's sigma_px is
/// half of look 1's and half of the later look's noise, by variance.
///
/// Features: Huber's loss first, then each feature's pixels against each other (chi-square, 99.9
/// %), then features behind the camera. Fewer than 8 are none. They are distrusted when less than
/// half of their pixels agree, when their residuals are over three times their sigmas (up to that,
/// the residuals are believed and not the sigmas), when they are over 1.1 times their sigmas and
/// the target's looks contradict each other, or when the angles they ask for are implausible even
/// with encoders twice as bad as told (chi-square of the readings' errors).
///
/// Target: a look goes that the others contradict most, while the image points contradict each
/// other as a whole or one look's innovation does (chi-square, 99.9 %, widened as the gate's is);
/// those that are left must be more than those that went, else TARGET_LOST. Without features, a
/// look whose pair with look 1 contradicts itself has gone from the start.
///
/// Then as estimate_point, in its order, but by the refined angles and what is left of their
/// uncertainty: DEGENERATE when that is true of every look. The parallax is the widest, residual_px
/// the root of the summed squares of all looks' residuals over the number of later looks: of two
/// looks, a pair's residual.
///
/// What a next look is worth is the information of the same problem with that look in it: its
/// target and the features that it would see where they are expected.
///
/// Allocates nothing but the text of reasons. Throws std::invalid_argument for fewer than 2 or more
/// than `looks_max` looks, and for more than `features_max` features.
[[nodiscard]] Estimate locate(const geometry::Rig& rig, std::span<const Look> looks,
                              std::span<const FeatureObservations> features, const Gate& gate,
                              const NextLook& next_look = {});

}  // namespace gazed::triangulation::all_looks
