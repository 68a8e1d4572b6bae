#include "agent/triangulation/degeneracy.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "agent/base/text.hpp"
#include "agent/triangulation/methods/optimal.hpp"

namespace gazed::triangulation {

namespace {

/// A shorter baseline is the rounding of two equal poses.
constexpr double baseline_min_m = 1e-9;

/// How far the ray is from the baseline, in units of its own image noise.
double sigmas_off_baseline(const ImagePoint& point, const Eigen::Vector3d& baseline_direction) {
  const double distance = point.normalised.homogeneous().cross(baseline_direction).norm();
  const double variance = 0.5 * normalised_covariance(point).trace();  // per axis
  return distance / std::sqrt(variance);
}

bool is_at_epipole(const ImagePoint& point, const Eigen::Vector3d& baseline_direction) {
  return point.normalised.homogeneous().cross(baseline_direction).norm() <=
         methods::epipole_distance_min;
}

}  // namespace

std::optional<std::string> what_is_degenerate(const TwoViews& views, double sigma_m,
                                              const Gate& gate) {
  const geometry::Pose& pose = views.cam2_from_cam1;
  const double baseline_m = pose.translation.norm();
  if (!(baseline_m > baseline_min_m)) return "the camera did not move: no baseline";
  if (baseline_m <= gate.baseline_sigmas * sigma_m) {
    return base::text("baseline %.2f mm is within %.1f sigmas of none (sigma %.2f mm)",
                      1e3 * baseline_m, gate.baseline_sigmas, 1e3 * sigma_m);
  }
  const Eigen::Vector3d direction = pose.translation / baseline_m;
  const Eigen::Vector3d direction_1 = pose.rotation.transpose() * direction;
  const double off_1 = sigmas_off_baseline(views.point_1, direction_1);
  const double off_2 = sigmas_off_baseline(views.point_2, direction);
  if (off_1 <= gate.baseline_sigmas && off_2 <= gate.baseline_sigmas) {
    return base::text("both rays lie along the baseline: %.1f and %.1f sigmas off it", off_1,
                      off_2);
  }
  if (is_at_epipole(views.point_1, direction_1) || is_at_epipole(views.point_2, direction)) {
    return "an image point is at its epipole";
  }
  return std::nullopt;
}

}  // namespace gazed::triangulation
