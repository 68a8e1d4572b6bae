// All looks at one target as one least-squares problem (SPEC 4): where the target is, how the head
// truly stood at every look, and what is believed of the robot's calibration, from the target's and
// the background's image points.
//
// Unknown: the target's ray in look 1 and its inverse range; a ray and an inverse depth of every
// background feature; two angles of every look, with the encoders' readings as prior; focal length,
// principal point, mount offset, mount rotation and joint zeros, with their sigmas as prior. A
// background point's depth is never assumed: it is an unknown that is eliminated. The covariance of
// the answer is that of the whole problem, so what the looks have in common is never averaged away.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/triangulation/feature_track.hpp"
#include "agent/triangulation/fusion.hpp"
#include "agent/triangulation/gate.hpp"

namespace gazed {

/// What the background did for the looks' angles.
enum class Refinement {
  none,       // no features, or too few: the angles are the encoders', improved by the target alone
  used,       // angles and target come from everything together
  distrusted  // the features contradict each other or the encoders: left out
};

struct JointEstimate {
  FusedEstimate fused;  // as of fuse_looks
  Refinement refinement = Refinement::none;
  std::array<HeadAngles, looks_max> head;  // as the sensors should have said
  std::size_t features_used = 0;           // seen in at least one later look, and agreeing
  std::size_t features_rejected = 0;
};

/// Decides as estimate_point does, in its order, and drops looks that contradict the others as
/// fuse_looks does. Never allocates. Throws std::invalid_argument for fewer than 2 or more than
/// `looks_max` looks, and for more than `features_max` features.
[[nodiscard]] JointEstimate locate_jointly(const HeadGeometry& head, const CameraModel& camera,
                                           const Uncertainty& uncertainty,
                                           std::span<const Look> looks,
                                           std::span<const FeatureTrack> features,
                                           const Gate& gate);

}  // namespace gazed
