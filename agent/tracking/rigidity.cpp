#include "agent/tracking/rigidity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "agent/geometry/cholesky.hpp"
#include "agent/triangulation/feature_observations.hpp"

namespace gazed::tracking {

namespace {

// Three free angles can make fewer pairs than this agree by chance.
constexpr std::size_t pairs_min = 8;
constexpr double baseline_min_m = 1e-3;
constexpr int iterations = 10;
// The scale of the robust loss shrinks from the effect of wrong angles to the error of tracking, in
// normalised coordinates (about 5 px and 0.2 px).
constexpr double first_scale = 8e-3, last_scale = 3e-4;
// A pair farther off than this many standard deviations, its own and the others', is not rigid.
constexpr double sigmas_max = 3.0;
constexpr double normal_mad = 0.6745;  // median of |x| of a standard normal x

// Yaw of the later look relative to the first, and both pitches: yaw of the torso itself has no
// effect.
using Angles = Eigen::Vector3d;

class Essential {
 public:
  Essential(const geometry::HeadGeometry& head, const Angles& angles) {
    const geometry::Pose pose =
        geometry::cam2_from_cam1(head, {0.0, angles[1]}, {angles[0], angles[2]});
    Eigen::Matrix3d cross;
    const Eigen::Vector3d t = pose.translation.normalized();
    cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    matrix_ = cross * pose.rotation;
  }
  /// Signed distance from the pair's epipolar line in view 2.
  [[nodiscard]] double distance(const PointPair& pair) const {
    const Eigen::Vector3d line = matrix_ * pair.normalised_1.homogeneous();
    return line.dot(pair.normalised_2.homogeneous()) / line.head<2>().norm();
  }

 private:
  Eigen::Matrix3d matrix_;
};

double median_magnitude(std::span<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// One step of least squares on all pairs, each weighted by (1 + (distance / scale)^2)^-2 (Geman and
// McClure 1987).
Angles improved(const geometry::HeadGeometry& head, const Angles& start, const Angles& angles,
                double angle_sigma_rad, double scale, std::span<const PointPair> pairs) {
  constexpr double difference = 1e-5;
  const Essential here(head, angles);
  const auto beside = [&](int k) { return Essential(head, angles + difference * Angles::Unit(k)); };
  const std::array<Essential, 3> around{beside(0), beside(1), beside(2)};
  const double prior = scale * scale / (angle_sigma_rad * angle_sigma_rad);
  Eigen::Matrix3d matrix = prior * Eigen::Matrix3d::Identity();
  Angles right_side = prior * (start - angles);
  for (const PointPair& pair : pairs) {
    const double distance = here.distance(pair);
    Angles slope;
    for (int k = 0; k < 3; ++k) {
      slope[k] = (around[static_cast<std::size_t>(k)].distance(pair) - distance) / difference;
    }
    const double root = 1.0 + distance * distance / (scale * scale);
    const double weight = 1.0 / (root * root);
    matrix.noalias() += weight * slope * slope.transpose();
    right_side.noalias() -= weight * distance * slope;
  }
  if (!geometry::factorise(matrix))
    return Angles::Constant(std::numeric_limits<double>::quiet_NaN());
  geometry::solve_factorised(matrix, right_side);
  return angles + right_side;
}

}  // namespace

void mark_rigid(const geometry::HeadGeometry& head, geometry::HeadAngles look_1,
                geometry::HeadAngles look_2, double angle_sigma_rad, std::span<PointPair> pairs) {
  const Angles start(look_2.yaw_rad - look_1.yaw_rad, look_1.pitch_rad, look_2.pitch_rad);
  if (pairs.size() < pairs_min || pairs.size() > triangulation::features_max ||
      geometry::cam2_from_cam1(head, look_1, look_2).translation.norm() < baseline_min_m) {
    return;
  }
  Angles angles = start;
  const double shrink = std::pow(last_scale / first_scale, 1.0 / (iterations - 1));
  double scale = first_scale;
  for (int i = 0; i < iterations; ++i, scale *= shrink) {
    angles = improved(head, start, angles, angle_sigma_rad, scale, pairs);
  }
  if (!angles.allFinite()) return;

  const Essential essential(head, angles);
  std::array<double, triangulation::features_max> distances{}, magnitudes{};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    distances[i] = magnitudes[i] = essential.distance(pairs[i]);
  }
  const double common = median_magnitude(std::span(magnitudes).first(pairs.size())) / normal_mad;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double sigma = std::hypot(pairs[i].sigma, common);
    pairs[i].rigid = std::abs(distances[i]) <= sigmas_max * sigma;
  }
}

}  // namespace gazed::tracking
