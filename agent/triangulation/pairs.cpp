#include "agent/triangulation/pairs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "agent/triangulation/solution.hpp"

namespace gazed::triangulation {

double inverse_range(const geometry::InverseDepthPoint& point) {
  return point.inverse_depth_per_m / point.direction.homogeneous().norm();
}

std::optional<Pair> comparable_pair(const Observation& observation, std::size_t look,
                                    const PointEstimate& estimate) {
  if (!std::isfinite(estimate.inverse_range_per_m)) return std::nullopt;
  const geometry::Pose& pose = observation.views.cam2_from_cam1;
  const auto point =
      methods::solve(methods::Method::optimal, pose, observation.views.point_1.normalised,
                     observation.views.point_2.normalised);
  if (!point) return std::nullopt;
  // Beyond camera 2's image plane its linearisation means nothing.
  const Eigen::Vector3d ray_2 = pose.rotation * point->direction.homogeneous() +
                                point->inverse_depth_per_m * pose.translation;
  if (!(ray_2.z() > 0.0)) return std::nullopt;
  return Pair{look, observation, estimate, *point};
}

geometry::InverseDepthPoint weighted_mean(std::span<const Pair> pairs, const PairVector& weights) {
  geometry::InverseDepthPoint out{Eigen::Vector2d::Zero(), 0.0};
  double mean_inverse_range = 0.0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double weight = weights(static_cast<Eigen::Index>(k));
    out.direction += weight * pairs[k].point.direction;
    mean_inverse_range += weight * inverse_range(pairs[k].point);
  }
  out.inverse_depth_per_m = mean_inverse_range * out.direction.homogeneous().norm();
  return out;
}

geometry::InverseDepthPoint mean_by_information(std::span<const Pair> pairs) {
  PairVector weights(static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    weights(static_cast<Eigen::Index>(k)) =
        std::pow(pairs[k].estimate.inverse_range_sigma_per_m, -2);
  }
  weights /= weights.sum();
  if (!weights.allFinite()) weights.setConstant(1.0 / static_cast<double>(pairs.size()));
  geometry::InverseDepthPoint mean = weighted_mean(pairs, weights);
  mean.inverse_depth_per_m = std::max(0.0, mean.inverse_depth_per_m);
  return mean;
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

}  // namespace gazed::triangulation
