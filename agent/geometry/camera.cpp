#include "agent/geometry/camera.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "agent/geometry/lens.hpp"

namespace gazed::geometry {

namespace {

using Coefficients = std::array<double, 5>;

// Most cameras are said to have none, and every pixel of a simulated picture asks.
bool has_none(const Coefficients& distortion) {
  return distortion == Coefficients{};
}

Eigen::Vector2d distort(const Coefficients& distortion, const Eigen::Vector2d& u) {
  return distorted(distortion.data(), u);
}

// d distort / d u. Symmetric: the distortion is the gradient of a potential.
Eigen::Matrix2d distortion_jacobian(const Coefficients& distortion, const Eigen::Vector2d& u) {
  const auto [k1, k2, p1, p2, k3] = distortion;
  const double x = u.x(), y = u.y(), s = u.squaredNorm();
  const double radial = 1.0 + s * (k1 + s * (k2 + s * k3));
  const double radial_slope = k1 + s * (2.0 * k2 + s * 3.0 * k3);  // d radial / d s
  const double mixed = 2.0 * x * y * radial_slope + 2.0 * p1 * x + 2.0 * p2 * y;
  Eigen::Matrix2d jacobian;
  jacobian << radial + 2.0 * x * x * radial_slope + 2.0 * p1 * y + 6.0 * p2 * x, mixed,  //
      mixed, radial + 2.0 * y * y * radial_slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return jacobian;
}

// The least slope of the radial profile r (1 + k1 r^2 + k2 r^4 + k3 r^6) on [0, radius]: the least
// of the cubic 1 + 3 k1 s + 5 k2 s^2 + 7 k3 s^3 on [0, radius^2], which its ends and its stationary
// points decide. A coefficient of 0 makes one of those infinite or NaN: the comparison drops it.
double least_radial_slope(const Coefficients& distortion, double radius) {
  const double k1 = distortion[0], k2 = distortion[1], k3 = distortion[4];
  const auto slope = [&](double s) { return 1.0 + s * (3.0 * k1 + s * (5.0 * k2 + s * 7.0 * k3)); };
  const double s_end = radius * radius;
  double least = std::min(slope(s_end), 1.0);  // in this order it keeps a NaN
  const double discriminant = 25.0 * k2 * k2 - 63.0 * k1 * k3;
  if (discriminant < 0.0) return least;
  const double q = -(5.0 * k2 + std::copysign(std::sqrt(discriminant), k2));
  for (const double s : {q / (21.0 * k3), 3.0 * k1 / q}) {
    if (s > 0.0 && s < s_end) least = std::min(least, slope(s));
  }
  return least;
}

// By bounds that hold for most lenses and all of their frame, and take no roots: false when they do
// not tell.
bool plainly_invertible_within(const Coefficients& distortion, double radius) {
  const auto [k1, k2, p1, p2, k3] = distortion;
  const double s = radius * radius;
  const double most_fall =
      s * (3.0 * std::abs(k1) + s * (5.0 * std::abs(k2) + s * 7.0 * std::abs(k3)));
  return most_fall + 6.0 * (std::abs(p1) + std::abs(p2)) * radius < 1.0;
}

// Whether the distortion is one to one on the disc of this radius. The radial part's Jacobian has
// no eigenvalue below the profile's least slope, the tangential part's none below -6 |p| r, so
// where the first exceeds the second the potential is strictly convex on the disc and its gradient
// takes no value twice. Exact without tangential distortion, on the safe side with it.
bool invertible_within(const Coefficients& distortion, double radius) {
  if (has_none(distortion)) return std::isfinite(radius * radius);
  if (plainly_invertible_within(distortion, radius)) return true;
  const double tangential = std::hypot(distortion[2], distortion[3]);
  return least_radial_slope(distortion, radius) > 6.0 * tangential * radius;
}

}  // namespace

bool invertible_within(const CameraModel& camera, double radius) {
  return invertible_within(camera.distortion, radius);
}

Eigen::Matrix3d calibration_matrix(const CameraModel& camera) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k(0, 0) = camera.focal_px.x();
  k(1, 1) = camera.focal_px.y();
  k.topRightCorner<2, 1>() = camera.centre_px;
  return k;
}

// Newton from the optical axis, each step halved until it stays where the distortion is one to one
// and comes closer: it can neither leave for the far side of a fold nor cycle.
std::optional<Eigen::Vector2d> normalise(const CameraModel& camera, const Pixel& pixel) {
  constexpr int max_iterations = 50;
  constexpr double tolerance = 1e-13;     // relative; distort() itself rounds at about 1e-15
  constexpr double least_damping = 1e-9;  // a step this short is going nowhere
  const Coefficients& distortion = camera.distortion;
  const Eigen::Vector2d distorted = (pixel - camera.centre_px).cwiseQuotient(camera.focal_px);
  if (!std::isfinite(distorted.squaredNorm())) return std::nullopt;
  if (has_none(distortion)) return distorted;

  Eigen::Vector2d u = Eigen::Vector2d::Zero();
  Eigen::Vector2d residual = distorted;  // distort(0) = 0
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (residual.norm() <= tolerance * (1.0 + distorted.norm())) return u;
    const Eigen::Vector2d step = distortion_jacobian(distortion, u).inverse() * residual;
    double damping = 1.0;
    for (;; damping *= 0.5) {
      if (damping < least_damping) return std::nullopt;
      const Eigen::Vector2d candidate = u + damping * step;
      if (!invertible_within(distortion, candidate.norm())) continue;
      const Eigen::Vector2d candidate_residual = distorted - distort(distortion, candidate);
      if (!(candidate_residual.norm() < residual.norm())) continue;
      u = candidate;
      residual = candidate_residual;
      break;
    }
  }
  return std::nullopt;
}

Pixel pixel_of(const CameraModel& camera, const Eigen::Vector2d& normalised) {
  if (has_none(camera.distortion)) {
    return camera.focal_px.cwiseProduct(normalised) + camera.centre_px;
  }
  return camera.focal_px.cwiseProduct(distort(camera.distortion, normalised)) + camera.centre_px;
}

Eigen::Matrix2d pixel_jacobian(const CameraModel& camera, const Eigen::Vector2d& normalised) {
  if (has_none(camera.distortion)) return camera.focal_px.asDiagonal();
  return camera.focal_px.asDiagonal() * distortion_jacobian(camera.distortion, normalised);
}

std::optional<Pixel> project(const CameraModel& camera, const Eigen::Vector3d& point_in_cam) {
  if (!(point_in_cam.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d normalised = point_in_cam.head<2>() / point_in_cam.z();
  if (!invertible_within(camera.distortion, normalised.norm())) return std::nullopt;
  return pixel_of(camera, normalised);
}

}  // namespace gazed::geometry
