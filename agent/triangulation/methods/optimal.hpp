// Optimal triangulation: finds the pair of image points nearest to the measured ones whose rays
// meet (Hartley and Sturm 1997; Hartley and Zisserman 2004, algorithm 12.1, "HZ"). Where Russcher
// 2011, 3.3, differs, the report is wrong: agent/triangulation/README.md.
//
// All image points are normalised: on the plane z = 1, distortion undone.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::triangulation::methods {

/// A point nearer to its epipole than this (normalised units) has no direction to be corrected in.
/// Far below any image noise: a millionth of a pixel.
inline constexpr double epipole_distance_min = 1e-9;

struct CorrectedPair {
  Eigen::Vector2d point_1, point_2;
  double cost = 0.0;  // summed squared distances to the measured points
};

/// The pair that satisfies the epipolar constraint with the least summed squared distance to
/// `point_1` and `point_2`: the global minimum, not the nearest local one, within rounding, for
/// every input. None for a zero baseline and if a point is at its epipole (nearer than
/// `epipole_distance_min`). Allocates no memory.
[[nodiscard]] std::optional<CorrectedPair> correct_optimally(const geometry::Pose& cam2_from_cam1,
                                                             const Eigen::Vector2d& point_1,
                                                             const Eigen::Vector2d& point_2);

/// Where the rays of a corrected pair meet; the baseline must not be zero. Not finite if the point
/// is camera 1's centre or anywhere on the baseline.
[[nodiscard]] geometry::InverseDepthPoint intersect(const geometry::Pose& cam2_from_cam1,
                                                    const CorrectedPair& pair);

}  // namespace gazed::triangulation::methods
