// All looks at one target as one least-squares problem: where the target is, how the head really
// stood at every look, and what the robot's calibration is, given the image points of the target
// and the background.
//
// The unknowns are the target's ray in look 1 and its inverse range; a ray and an inverse depth for
// every background feature; two angles for every look, with the encoders' readings as prior; and
// focal length, principal point, mount offset, mount rotation and joint zeros, with their sigmas as
// prior. A background point's depth is never assumed: it is an unknown that is eliminated. The
// covariance of the answer comes from the whole problem, so errors that the looks have in common
// are not averaged away.
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

/// How the background was used for the looks' angles.
enum class Refinement {
  none,       // no or too few features: encoder angles, improved by the target alone
  used,       // angles and target are estimated from everything together
  distrusted  // the features contradict each other or the encoders and are left out
};

struct Estimate {
  /// As for a single pair. The reason also names the looks that were not used.
  PointEstimate point;
  std::array<LookVerdict, looks_max> looks;  // in the given order; the first is used if any is
  ErrorBudget budget;                        // of point.inverse_range_sigma_per_m, squared
  std::size_t looks_used = 0;                // including the first
  double chi2 = not_a_number;                // of the target's image points
  int degrees_of_freedom = 0;                // of chi2: two per later look, minus one

  Refinement refinement = Refinement::none;
  /// What error-free sensors would have reported, with the configured joint zeros.
  std::array<geometry::HeadAngles, looks_max> head;
  /// The same with the estimated joint zeros, which are in `robot`.
  std::array<geometry::HeadAngles, looks_max> reading;
  /// The torso's pose at every look relative to look 1: the identity if it did not move.
  std::array<geometry::Pose, looks_max> torso_1_from_torso;
  /// After the looks. Its kinematic chain at reading[0] maps point.point_m to point.torso_point_m.
  BelievedRobot robot;
  std::size_t features_used = 0;  // seen in at least one later look and consistent
  std::size_t features_rejected = 0;
  /// Bit k is set if the pixel in look k was believed; indexed by feature, as given.
  std::array<std::uint16_t, features_max> feature_used_in{};
  /// Sigma of the inverse range expected if the next look is as good as the last one. NaN if none
  /// is planned or if it would not see the target.
  double expected_sigma_per_m = not_a_number;
};

/// Called once with the estimate, complete but for the expectation: returns where the next look
/// would go, or none if the expectation is not wanted.
using NextLook = std::function<std::optional<geometry::HeadAngles>(const Estimate&)>;

/// The target's pixel in look 1 defines the point and has no noise. Pixels in later looks have
/// Uncertainty::pixel_sigma_px plus their registration's covariance. A feature's sigma_px contains
/// the noise of look 1 and of the later look in equal parts, by variance.
///
/// Features: first Huber's loss, then each feature's pixels are checked against each other
/// (chi-square, 99.9 %), then features behind the camera are removed. Fewer than 8 features are not
/// used. The features are distrusted if fewer than half of their pixels agree; if their residuals
/// exceed three times their sigmas (up to that, sigmas are scaled to the residuals); if they exceed
/// 1.1 times their sigmas and the target's looks contradict each other; or if the angles they
/// require are implausible even for encoders twice as bad as stated (chi-square of the reading
/// errors).
///
/// Target: as long as all image points together contradict each other, or one look's innovation
/// does (chi-square, 99.9 %, widened like the gate's), the look that the others contradict most is
/// dropped. More looks must be left than were dropped, otherwise TARGET_LOST. Without features, a
/// look whose pair with look 1 contradicts itself is dropped from the start.
///
/// Then the checks of estimate_point, in its order, but with the refined angles and their remaining
/// uncertainty; DEGENERATE only if every look is. The parallax is the widest one. residual_px is
/// the square root of the summed squares of all looks' residuals divided by the number of later
/// looks; for two looks it is the pair's residual.
///
/// The value of a next look is predicted by adding it to the problem, with the target and the
/// features that it should see at their expected pixels.
///
/// Allocates nothing but the text of reasons. Throws std::invalid_argument for fewer than 2 or more
/// than `looks_max` looks, and for more than `features_max` features.
[[nodiscard]] Estimate locate(const geometry::Rig& rig, std::span<const Look> looks,
                              std::span<const FeatureObservations> features, const Gate& gate,
                              const NextLook& next_look = {});

}  // namespace gazed::triangulation::all_looks
