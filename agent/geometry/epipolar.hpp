// Two-view geometry: with x2 = R x1 + t, a point's two images satisfy x2^T E x1 = 0, E = [t]x R
// (Hartley and Zisserman 2004, 9.6).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::geometry {

[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// E of normalised coordinates, not scaled: |E| grows with the baseline.
[[nodiscard]] Eigen::Matrix3d essential_matrix(const Pose& cam2_from_cam1);

/// F of pixels: K2^-T E K1^-1, scaled to unit Frobenius norm. None for a zero baseline or a
/// singular K.
[[nodiscard]] std::optional<Eigen::Matrix3d> fundamental_matrix(const Eigen::Matrix3d& k1,
                                                                const Eigen::Matrix3d& k2,
                                                                const Pose& cam2_from_cam1);

}  // namespace gazed::geometry
