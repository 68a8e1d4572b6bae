// Optimal triangulation in two iterations (Lindstrom 2010, "Triangulation made easy", niter2).
//
// All image points are normalised: on the plane z = 1, distortion undone.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/pose.hpp"
#include "agent/triangulation/methods/optimal.hpp"

namespace gazed::triangulation::methods {

/// The same result as correct_optimally, several times as fast when the epipoles are far away
/// compared with the noise. The two iterations cannot tell whether they found a minimum, or the
/// global one, so that is checked; if the check fails, the answer comes from correct_optimally. The
/// cost is within 1e-6 (relative) of the minimum for every input.
[[nodiscard]] std::optional<CorrectedPair> correct_in_two_iterations(
    const geometry::Pose& cam2_from_cam1, const Eigen::Vector2d& point_1,
    const Eigen::Vector2d& point_2);

}  // namespace gazed::triangulation::methods
