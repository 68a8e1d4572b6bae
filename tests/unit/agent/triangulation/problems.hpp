// Random correspondences in the geometries that triangulation has to stand.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "agent/geometry/pose.hpp"

#include "random.hpp"

namespace gazed::triangulation {

/// The focal length behind "one pixel" of noise.
inline constexpr double problem_focal_px = 752.0;

/// Two normalised image points that are said to show one scene point.
struct Problem {
  geometry::Pose cam2_from_cam1;
  Eigen::Vector2d point_1, point_2;
};

enum class Geometry { head_turn, forward, general, noisy };
inline constexpr std::array geometries{Geometry::head_turn, Geometry::forward, Geometry::general,
                                       Geometry::noisy};

[[nodiscard]] std::string geometry_name(Geometry geometry);

[[nodiscard]] geometry::Pose random_pose(Geometry geometry, Random& random);

/// A scene point in front of both cameras, seen with noise: 8 px for `noisy`, else 1 px.
[[nodiscard]] Problem random_problem(Geometry geometry, Random& random);

}  // namespace gazed::triangulation
