#include "agent/triangulation/methods/method.hpp"

#include "agent/triangulation/methods/lindstrom.hpp"
#include "agent/triangulation/methods/optimal.hpp"
#include "agent/triangulation/methods/rectification.hpp"

namespace gazed::triangulation::methods {

namespace {

std::optional<geometry::InverseDepthPoint> solve_unchecked(Method method,
                                                           const geometry::Pose& cam2_from_cam1,
                                                           const Eigen::Vector2d& point_1,
                                                           const Eigen::Vector2d& point_2,
                                                           const MmseModel& mmse) {
  switch (method) {
    case Method::rectification: {
      const auto rectification = rectify(cam2_from_cam1);
      if (!rectification) return std::nullopt;
      return intersect_rectified(*rectification, point_1, point_2);
    }
    case Method::linear_mmse: {
      if (!(cam2_from_cam1.translation.norm() > 0.0)) return std::nullopt;
      const auto estimate = estimate_linear_mmse(cam2_from_cam1, point_1, point_2, mmse);
      if (!estimate) return std::nullopt;
      return geometry::inverse_depth_point(estimate->point_m);
    }
    case Method::optimal:
    case Method::lindstrom:
      break;
  }
  const auto pair = method == Method::lindstrom
                        ? correct_in_two_iterations(cam2_from_cam1, point_1, point_2)
                        : correct_optimally(cam2_from_cam1, point_1, point_2);
  if (!pair) return std::nullopt;
  return intersect(cam2_from_cam1, *pair);
}

}  // namespace

std::string_view name(Method method) {
  switch (method) {
    case Method::rectification:
      return "rectification";
    case Method::linear_mmse:
      return "linear-mmse";
    case Method::lindstrom:
      return "lindstrom";
    case Method::optimal:
      break;
  }
  return "optimal";
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const Method method : all_methods) names.push_back(name(method));
  return names;
}

std::optional<Method> method_of(std::string_view text) {
  for (const Method method : all_methods) {
    if (name(method) == text) return method;
  }
  return std::nullopt;
}

std::optional<geometry::InverseDepthPoint> solve(Method method,
                                                 const geometry::Pose& cam2_from_cam1,
                                                 const Eigen::Vector2d& point_1,
                                                 const Eigen::Vector2d& point_2,
                                                 const MmseModel& mmse) {
  const auto point = solve_unchecked(method, cam2_from_cam1, point_1, point_2, mmse);
  return point && point->is_finite() ? point : std::nullopt;
}

}  // namespace gazed::triangulation::methods
