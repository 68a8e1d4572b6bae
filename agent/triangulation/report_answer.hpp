// The answer of the report's own six steps (Russcher 2011, 4.4), for comparison.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/rig.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::triangulation {

/// Steps 5 and 6: the relative pose from the measured angles, with the chain that corrects eq. 4.2,
/// and optimal triangulation (3.3) of the two most salient places. In the torso frame. Nothing is
/// checked, so the point may lie behind the camera, as in the report's test 1. NaN if the method
/// has no answer or the point is at infinity.
[[nodiscard]] Eigen::Vector3d report_answer_m(const geometry::Rig& rig, const TwoLooks& looks);

}  // namespace gazed::triangulation
