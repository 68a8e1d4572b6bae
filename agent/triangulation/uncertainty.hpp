// How error sources affect a triangulated point, to first order.
//
// Near a solution, every method is a linear map from errors of the two image points to an error of
// (direction, inverse depth). An error of the relative pose acts like an error of view 2's image
// point. The methods differ only in that map.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/inverse_depth.hpp"
#include "agent/triangulation/error_sources.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::triangulation {

/// How a method's solution (direction, inverse depth) responds to its inputs.
struct Response {
  Eigen::Matrix<double, 3, 4> by_image_points;  // both normalised
  /// The effect of one standard deviation of three more independent causes, as columns: linear
  /// MMSE's prior.
  Eigen::Matrix3d by_prior = Eigen::Matrix3d::Zero();
};

/// The effect of one source on a solution.
struct SolutionError {
  Eigen::Vector3d solution;  // direction, inverse depth
  double residual = 0.0;     // across the epipolar surface, normalised units
};

/// Two views at a solution, linearised: x2 = project(R (direction, 1) + inverse_depth t).
///
/// The measured image points form a 4-vector. Those that are images of one scene point lie on a
/// three-dimensional surface (HZ 12.5 and 4.2.5). To first order, an error has a part along the
/// surface, which moves the point, and a part across, which is the epipolar residual, whatever the
/// method.
class Linearisation {
 public:
  Linearisation(const geometry::Pose& cam2_from_cam1, const geometry::InverseDepthPoint& solution);

  /// Where view 2 sees the solution.
  [[nodiscard]] const Eigen::Vector2d& view_2() const { return view_2_; }

  /// Response of the optimal method, and so of Lindstrom's: orthogonal projection onto the surface.
  /// With unit image noise the covariance is (J^T J)^-1 of the reprojection (HZ result 5.10).
  [[nodiscard]] Response optimal() const;
  /// Response of a method that keeps camera 1's ray and takes the depth from one measurement, whose
  /// gradient by point 2 is `gradient_2`.
  [[nodiscard]] Response along_ray_1(const Eigen::RowVector2d& gradient_2) const;

  /// The errors of the two image points that are equivalent to a source.
  [[nodiscard]] Eigen::Vector4d image_error(const ErrorSource& source) const;

  /// The part of an image error across the surface, normalised units.
  [[nodiscard]] double across(const Eigen::Vector4d& image_error) const {
    return across_.dot(image_error);
  }

  [[nodiscard]] SolutionError error(const Response& response, const ErrorSource& source) const;

 private:
  Eigen::Vector3d rotated_;
  double inverse_depth_;
  Eigen::Vector2d view_2_;
  Eigen::Matrix<double, 2, 3> projection_;  // d view 2 / d point in camera 2
  Eigen::Matrix2d by_direction_;
  Eigen::Vector2d by_inverse_depth_;
  Eigen::Vector4d across_;
};

/// How certain a solution is. Covariances are NaN unless the inverse depth is positive; the torso's
/// also if there is no torso.
struct Propagated {
  double inverse_range_per_m = not_a_number;
  double inverse_range_sigma_per_m = not_a_number;
  double residual = not_a_number;        // signed, normalised units
  double residual_sigma = not_a_number;  // from all sources
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
  Eigen::Matrix3d torso_covariance_m2 = Eigen::Matrix3d::Constant(not_a_number);
};

/// Sums the effects of independent sources on a solution.
class CovarianceSum {
 public:
  CovarianceSum(const geometry::InverseDepthPoint& solution,
                const std::optional<geometry::Pose>& torso_from_cam1);

  void add(const Eigen::Vector3d& solution_error, const PoseChange& torso_from_cam1_change);

  /// Everything except the residual.
  [[nodiscard]] Propagated result() const;

 private:
  geometry::InverseDepthPoint solution_;
  Eigen::Vector3d ray_;
  double ray_length_;
  std::optional<geometry::Pose> torso_;
  Eigen::Vector3d torso_offset_m_ = Eigen::Vector3d::Zero();  // from camera 1, torso axes
  double inverse_range_variance_ = 0.0;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d torso_covariance_ = Eigen::Matrix3d::Zero();
};

/// The error of the inverse range for a given error of the solution, 1/m.
[[nodiscard]] double inverse_range_error(const geometry::InverseDepthPoint& solution,
                                         const Eigen::Vector3d& solution_error);

/// A method's solution, and how it responds to errors of its inputs.
struct Solution {
  geometry::InverseDepthPoint point;
  Linearisation linearisation;
  Response response;
};

/// Propagates the image noise of both views and every source to `solution`.
[[nodiscard]] Propagated propagate(const TwoViews& views, const ErrorSources& sources,
                                   const Solution& solution);

}  // namespace gazed::triangulation
