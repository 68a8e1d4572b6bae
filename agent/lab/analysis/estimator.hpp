// The columns of table 3.3: how a point is made of a belief.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "agent/lab/analysis/setup.hpp"

namespace gazed::lab::analysis {

/// The report's three methods, and the replica of its optimal column. In that one the wrong
/// parameters only correct the image points (steps 1 to 10 of optimal triangulation); step 11, the
/// linear triangulation of eq. 3.18, is given the true projection matrices, which no robot has. It
/// is no method: it shows where numbers as small as the report's come from.
enum class Estimator { optimal, rectification, linear_mmse, replica };
inline constexpr std::array all_estimators{Estimator::optimal, Estimator::rectification,
                                           Estimator::linear_mmse, Estimator::replica};

/// "optimal", "rectification", "linear-mmse", "replica".
[[nodiscard]] std::string_view name(Estimator estimator);

/// The point in camera 1's frame, metres; it may be behind a camera. None where there is no finite
/// answer. `truth` is what the replica cheats with.
[[nodiscard]] std::optional<Eigen::Vector3d> reconstruct(Estimator estimator, const Belief& belief,
                                                         const Belief& truth);

/// Eq. 3.18: the null vector of the rows (u p3 - p1), (v p3 - p2) of both views (direct linear
/// transform), from normalised image points. The answer for rays that do not meet depends on how
/// the rows are scaled, which the report leaves open: here each to length 1, lengths in metres.
[[nodiscard]] std::optional<Eigen::Vector3d> triangulate_linearly(
    const geometry::Pose& cam2_from_cam1, const Eigen::Vector2d& point_1,
    const Eigen::Vector2d& point_2);

}  // namespace gazed::lab::analysis
