// The last check: how certain the inverse range is, and which status and numbers that allows.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/pose.hpp"
#include "agent/triangulation/gate.hpp"
#include "agent/triangulation/two_view.hpp"
#include "agent/triangulation/uncertainty.hpp"

namespace gazed::triangulation {

/// For a point that is not behind a camera; the inverse range and sigma of `out` must be set. Sets
/// status and reason and, unless the point may be at infinity, position, range and covariances.
void judge_sigma(const geometry::InverseDepthPoint& point, const Propagated& propagated,
                 const std::optional<geometry::Pose>& torso_from_cam1, const Gate& gate,
                 PointEstimate& out);

}  // namespace gazed::triangulation
