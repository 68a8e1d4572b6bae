#include "agent/triangulation/solution.hpp"

#include <Eigen/Core>
#include <stdexcept>

#include "agent/triangulation/methods/rectification.hpp"

namespace gazed::triangulation {

namespace {

std::optional<Solution> solve_linear_mmse(const TwoViews& views, const methods::Prior& prior) {
  const auto estimate = methods::estimate_linear_mmse(
      views.cam2_from_cam1, views.point_1.normalised, views.point_2.normalised,
      {prior, normalised_covariance(views.point_1), normalised_covariance(views.point_2)});
  if (!estimate) return std::nullopt;
  const geometry::InverseDepthPoint point = geometry::inverse_depth_point(estimate->point_m);
  if (!point.is_finite()) return std::nullopt;
  // (x, y, z) to (x / z, y / z, 1 / z)
  const double w = point.inverse_depth_per_m;
  const Eigen::Matrix3d by_point{
      {w, 0, -w * point.direction.x()}, {0, w, -w * point.direction.y()}, {0, 0, -w * w}};
  return Solution{
      point, Linearisation(views.cam2_from_cam1, point),
      Response{by_point * estimate->by_image_points_m, by_point * estimate->by_prior_m}};
}

}  // namespace

std::optional<Solution> solution_at(const geometry::InverseDepthPoint& point,
                                    methods::Method method, const TwoViews& views) {
  if (method == methods::Method::linear_mmse) {
    throw std::invalid_argument("linear MMSE has no response at a point that is not its own");
  }
  const Linearisation linearisation(views.cam2_from_cam1, point);
  if (method != methods::Method::rectification) {
    return Solution{point, linearisation, linearisation.optimal()};
  }
  const auto rectification = methods::rectify(views.cam2_from_cam1);
  if (!rectification) return std::nullopt;
  return Solution{point, linearisation,
                  linearisation.along_ray_1(
                      methods::rectified_gradient_2(*rectification, linearisation.view_2()))};
}

std::optional<Solution> solve(methods::Method method, const TwoViews& views,
                              const methods::Prior& prior) {
  if (method == methods::Method::linear_mmse) return solve_linear_mmse(views, prior);
  const auto point = methods::solve(method, views.cam2_from_cam1, views.point_1.normalised,
                                    views.point_2.normalised);
  if (!point) return std::nullopt;
  return solution_at(*point, method, views);
}

}  // namespace gazed::triangulation
