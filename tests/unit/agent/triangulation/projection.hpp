// Cameras that are given as 3x4 projection matrices.
#pragma once

#include <Eigen/Core>

#include "agent/geometry/pose.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// K [R | t].
struct Projection {
  Eigen::Matrix3d k;
  geometry::Pose cam_from_world;
};

/// Of any scale and sign (Hartley and Zisserman 2004, 6.2.4): RQ decomposition, by Gram and Schmidt
/// from the last row.
[[nodiscard]] Projection decompose(const Eigen::Matrix<double, 3, 4>& p);

/// A pixel of a camera without distortion, but possibly with skew.
[[nodiscard]] ImagePoint image_point(const Eigen::Matrix3d& k, const Eigen::Vector2d& pixel,
                                     double pixel_sigma_px);

/// `cam2_from_cam1` of two cameras in one world.
[[nodiscard]] geometry::Pose relative_pose(const geometry::Pose& cam1_from_world,
                                           const geometry::Pose& cam2_from_world);

}  // namespace gazed::triangulation
