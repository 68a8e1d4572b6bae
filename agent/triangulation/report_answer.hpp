// The answer that the report's own six steps give (Russcher 2011, 4.4), for comparison.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/rig.hpp"
#include "agent/triangulation/estimate.hpp"

namespace gazed::triangulation {

/// Steps 5 and 6: the relative pose from the measured angles, with the chain that corrects eq. 4.2,
/// and optimal triangulation (3.3) of the two most salient places. Torso frame; nothing is judged,
/// so it may lie behind the camera, as the report's test 1 did. NaN where the method has no answer,
/// or one at infinity.
[[nodiscard]] Eigen::Vector3d report_answer_m(const geometry::Rig& rig, const TwoLooks& looks);

}  // namespace gazed::triangulation
