#include "agent/triangulation/all_looks/pair.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "agent/geometry/pose.hpp"
#include "agent/triangulation/feature_observations.hpp"
#include "agent/triangulation/methods/method.hpp"

namespace gazed::triangulation::all_looks {

std::optional<geometry::InverseDepthPoint> comparable_point(const Observation& observation,
                                                            const PointEstimate& estimate) {
  if (!std::isfinite(estimate.inverse_range_per_m)) return std::nullopt;
  const geometry::Pose& pose = observation.views.cam2_from_cam1;
  const auto point =
      methods::solve(methods::Method::optimal, pose, observation.views.point_1.normalised,
                     observation.views.point_2.normalised);
  if (!point) return std::nullopt;
  // Behind camera 2's image plane the linearisation is meaningless.
  const Eigen::Vector3d ray_2 = pose.rotation * point->direction.homogeneous() +
                                point->inverse_depth_per_m * pose.translation;
  if (!(ray_2.z() > 0.0)) return std::nullopt;
  return point;
}

double mean_inverse_depth_per_m(std::span<const Pair> pairs) {
  // One entry per pair with a point; allocates no memory.
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, static_cast<int>(looks_max) - 1, 1> weights(
      std::ranges::count_if(pairs, [](const Pair& pair) { return pair.point.has_value(); }));
  if (weights.size() == 0) return 0.0;
  Eigen::Index i = 0;
  for (const Pair& pair : pairs) {
    if (pair.point) weights(i++) = std::pow(pair.estimate.inverse_range_sigma_per_m, -2);
  }
  weights /= weights.sum();
  // Without any noise the pairs agree and any weights will do.
  if (!weights.allFinite()) weights.setConstant(1.0 / static_cast<double>(weights.size()));
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  double inverse_range_per_m = 0.0;
  i = 0;
  for (const Pair& pair : pairs) {
    if (!pair.point) continue;
    const double weight = weights(i++);
    direction += weight * pair.point->direction;
    inverse_range_per_m +=
        weight * (pair.point->inverse_depth_per_m / pair.point->direction.homogeneous().norm());
  }
  return std::max(0.0, inverse_range_per_m * direction.homogeneous().norm());
}

bool came_further(Status a, Status b) {
  const auto checks_passed = [](Status status) {
    switch (status) {
      case Status::invalid_input:
        return 0;
      case Status::degenerate:
        return 1;
      case Status::target_lost:
        return 2;
      default:
        return 3;
    }
  };
  return checks_passed(a) > checks_passed(b);
}

}  // namespace gazed::triangulation::all_looks
