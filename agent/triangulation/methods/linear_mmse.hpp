// Linear minimum mean square error: the point as a Gaussian variable with a prior, the rows of both
// projections as its noisy measurements (Russcher 2011, 3.2; the printed covariance cancels, see
// agent/triangulation/README.md).
//
// A row (u p3 - p1) X = 0 is linear in X but for its noise, which is that of the image point times
// the point's depth: the depth of the previous estimate is used, first the prior mean's, and the
// estimate is made twice, both times from the prior.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/pose.hpp"

namespace gazed::triangulation::methods {

/// Where points are before anything is seen, in camera 1's frame; independent axes. As built: the
/// report's working space, 0.1 to 1.5 m ahead.
struct Prior {
  Eigen::Vector3d mean_m{0.0, 0.0, 0.8};
  Eigen::Vector3d sigma_m{0.25, 0.25, 0.7};
};

/// What linear MMSE is told beyond the correspondence.
struct MmseModel {
  Prior prior;
  /// Covariances of the image points, normalised units: as built the report's 0.12 px at f 752 px.
  Eigen::Matrix2d noise_1 = 0.12 / 752.0 * 0.12 / 752.0 * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d noise_2 = noise_1;
};

struct MmseEstimate {
  Eigen::Vector3d point_m;
  Eigen::Matrix3d covariance_m2;  // Cx_new: of the image noise and of what the prior leaves open
  /// d point / d (image point 1, image point 2), normalised units.
  Eigen::Matrix<double, 3, 4> by_image_points_m;
  /// What one sigma of the prior along each axis does to the point, as columns. With the image
  /// noise these make up covariance_m2.
  Eigen::Matrix3d by_prior_m;
};

/// None for a prior whose sigma is not positive, and where anything is not finite. Noise below 1e-9
/// (normalised units) counts as that.
[[nodiscard]] std::optional<MmseEstimate> estimate_linear_mmse(const geometry::Pose& cam2_from_cam1,
                                                               const Eigen::Vector2d& point_1,
                                                               const Eigen::Vector2d& point_2,
                                                               const MmseModel& model);

}  // namespace gazed::triangulation::methods
