// Linear minimum mean square error: the point is a Gaussian variable with a prior, and the rows of
// both projections are noisy measurements of it (Russcher 2011, 3.2; the printed covariance suffers
// from cancellation, see agent/triangulation/README.md).
//
// A row (u p3 - p1) X = 0 is linear in X except for its noise, which is that of the image point
// times the point's depth. The depth comes from the previous estimate: first from the prior mean,
// then from a first estimate. Both estimates start from the prior.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/pose.hpp"

namespace gazed::triangulation::methods {

/// Where points are expected before anything is seen, in camera 1's frame; axes are independent.
/// The default is the report's working space, 0.1 to 1.5 m ahead.
struct Prior {
  Eigen::Vector3d mean_m{0.0, 0.0, 0.8};
  Eigen::Vector3d sigma_m{0.25, 0.25, 0.7};
};

/// What linear MMSE needs besides the correspondence.
struct MmseModel {
  Prior prior;
  /// Covariances of the image points, normalised units. Default: the report's 0.12 px at f = 752
  /// px.
  Eigen::Matrix2d noise_1 = 0.12 / 752.0 * 0.12 / 752.0 * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d noise_2 = noise_1;
};

struct MmseEstimate {
  Eigen::Vector3d point_m;
  // Cx_new: from the image noise and from what the prior leaves open
  Eigen::Matrix3d covariance_m2;
  /// d point / d (image point 1, image point 2), normalised units.
  Eigen::Matrix<double, 3, 4> by_image_points_m;
  /// How one sigma of the prior along each axis moves the point, as columns. Together with the
  /// image noise these give covariance_m2.
  Eigen::Matrix3d by_prior_m;
};

/// None if a sigma of the prior is not positive or if anything is not finite. Noise below 1e-9
/// (normalised units) is raised to that.
[[nodiscard]] std::optional<MmseEstimate> estimate_linear_mmse(const geometry::Pose& cam2_from_cam1,
                                                               const Eigen::Vector2d& point_1,
                                                               const Eigen::Vector2d& point_2,
                                                               const MmseModel& model);

}  // namespace gazed::triangulation::methods
