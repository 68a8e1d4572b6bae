#include "agent/triangulation/methods/optimal.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "agent/geometry/epipolar.hpp"
#include "agent/triangulation/methods/polynomial_roots.hpp"

namespace gazed::triangulation::methods {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Two views after HZ's steps 1 to 5: both points at the origin, both epipoles on the x axis at (1,
/// 0, f1) and (1, 0, f2), F = [f1 f2 d, -f2 c, -f2 d; -f1 b, a, b; -f1 d, c, d].
struct CanonicalViews {
  double f1, f2, a, b, c, d;
  Eigen::Matrix3d original_from_canonical_1, original_from_canonical_2;
};

/// Rotates about `point` so that the epipole falls on the x axis. None when they coincide.
std::optional<Eigen::Matrix3d> original_from_canonical(const Eigen::Vector2d& point,
                                                       const Eigen::Vector3d& epipole, double& f) {
  const Eigen::Vector2d offset = epipole.head<2>() - epipole.z() * point;
  const double length = offset.norm();
  if (!(length > epipole_distance_min)) return std::nullopt;
  const double cosine = offset.x() / length, sine = offset.y() / length;
  f = epipole.z() / length;
  return Eigen::Matrix3d{{cosine, -sine, point.x()}, {sine, cosine, point.y()}, {0, 0, 1}};
}

std::optional<CanonicalViews> canonical_views(const geometry::Pose& cam2_from_cam1,
                                              const Eigen::Vector2d& point_1,
                                              const Eigen::Vector2d& point_2) {
  const double baseline = cam2_from_cam1.translation.norm();
  if (!(baseline > 0.0)) return std::nullopt;
  const geometry::Pose unit{cam2_from_cam1.rotation, cam2_from_cam1.translation / baseline};
  CanonicalViews views{};
  const auto first =
      original_from_canonical(point_1, unit.rotation.transpose() * unit.translation, views.f1);
  const auto second = original_from_canonical(point_2, unit.translation, views.f2);
  if (!first || !second) return std::nullopt;
  views.original_from_canonical_1 = *first;
  views.original_from_canonical_2 = *second;
  const Eigen::Matrix3d f =
      second->transpose() * geometry::essential_matrix(unit).normalized() * *first;
  views.a = f(1, 1);
  views.b = f(1, 2);
  views.c = f(2, 1);
  views.d = f(2, 2);
  return views;
}

/// s(t), HZ (12.5): the summed squared distances of the origins to the epipolar lines through
/// (0, t, 1).
double cost_at(const CanonicalViews& v, double t) {
  const double at_b = v.a * t + v.b, ct_d = v.c * t + v.d;
  return t * t / (1.0 + v.f1 * v.f1 * t * t) +
         ct_d * ct_d / (at_b * at_b + v.f2 * v.f2 * ct_d * ct_d);
}

double cost_at_infinity(const CanonicalViews& v) {
  return 1.0 / (v.f1 * v.f1) + v.c * v.c / (v.a * v.a + v.f2 * v.f2 * v.c * v.c);
}

/// g(scale tau) as a polynomial in tau, HZ (12.7); its roots are the stationary points of s(t).
Polynomial stationary_polynomial(const CanonicalViews& v, double scale) {
  const double f1 = v.f1 * scale, f1_2 = f1 * f1, f2_2 = v.f2 * v.f2;
  const double a = v.a * scale, b = v.b, c = v.c * scale, d = v.d;
  // p = (at+b)^2 + f2^2 (ct+d)^2, q = (at+b)(ct+d)
  const double p0 = b * b + f2_2 * d * d, p1 = 2.0 * (a * b + f2_2 * c * d),
               p2 = a * a + f2_2 * c * c;
  const double q0 = b * d, q1 = a * d + b * c, q2 = a * c;
  // The factor 1 / scale of the second term comes from the substitution: everything is divided by
  // `scale`.
  const double k = (v.a * v.d - v.b * v.c) / scale;
  return {-k * q0,
          p0 * p0 - k * q1,
          2.0 * p0 * p1 - k * (q2 + 2.0 * f1_2 * q0),
          p1 * p1 + 2.0 * p0 * p2 - 2.0 * k * f1_2 * q1,
          2.0 * p1 * p2 - k * f1_2 * (2.0 * q2 + f1_2 * q0),
          p2 * p2 - k * f1_2 * f1_2 * q1,
          -k * f1_2 * f1_2 * q2};
}

/// Newton's method, to remove the rounding error of a root.
double polished(const Polynomial& g, double root) {
  constexpr int steps_max = 10;
  for (int i = 0; i < steps_max; ++i) {
    double value = g[degree_max], slope = 0.0;
    for (std::size_t k = degree_max; k-- > 0;) {
      slope = slope * root + value;
      value = value * root + g[k];
    }
    const double step = value / slope;
    if (!std::isfinite(step)) break;
    root -= step;
    if (std::abs(step) <= epsilon * std::abs(root)) break;
  }
  return root;
}

/// The t that minimises s(t); infinite for the line at the other end of the pencil.
double best_t(const CanonicalViews& v) {
  const double cost_at_zero = cost_at(v, 0.0);
  if (cost_at_zero == 0.0) return 0.0;
  // No better t lies outside [-scale, scale], since its first term alone would cost more than t =
  // 0. Near the epipole there is no such bound, and s(t) levels off at 1/f1.
  const double f1_2_cost = v.f1 * v.f1 * cost_at_zero;
  const bool bounded = f1_2_cost < 0.5;
  const double scale = bounded ? std::sqrt(cost_at_zero / (1.0 - f1_2_cost)) : 1.0 / std::abs(v.f1);
  const Polynomial g = stationary_polynomial(v, scale);
  // Within the bound, a leading coefficient this small hardly moves a root, and polishing corrects
  // that. If the noise is small against the distance to the epipole, most of the six coefficients
  // go, and with them most of the computing time.
  constexpr double negligible_when_bounded = 1e-10;
  const RealParts roots = real_parts_of_roots(g, bounded ? negligible_when_bounded : epsilon);

  double best = 0.0, best_cost = cost_at_zero;
  const auto consider = [&](double tau) {
    const double cost = cost_at(v, scale * tau);
    if (cost < best_cost) {
      best_cost = cost;
      best = tau;
    }
  };
  for (const double root : roots.values()) consider(root);
  if (v.f1 != 0.0 && cost_at_infinity(v) < best_cost) {
    return std::numeric_limits<double>::infinity();
  }
  // The cost is flat at its minimum: the polynomial, not the cost, shows whether a root is better.
  const double candidate = polished(g, best);
  constexpr double cost_rounding = 1e-12;
  if (cost_at(v, scale * candidate) <= best_cost * (1.0 + cost_rounding)) best = candidate;
  return scale * best;
}

/// The point on the line (p, q, r) closest to the origin, homogeneous.
Eigen::Vector3d closest_to_origin(const Eigen::Vector3d& line) {
  return {-line.x() * line.z(), -line.y() * line.z(), line.head<2>().squaredNorm()};
}

}  // namespace

std::optional<CorrectedPair> correct_optimally(const geometry::Pose& cam2_from_cam1,
                                               const Eigen::Vector2d& point_1,
                                               const Eigen::Vector2d& point_2) {
  const std::optional<CanonicalViews> views = canonical_views(cam2_from_cam1, point_1, point_2);
  if (!views) return std::nullopt;
  const CanonicalViews& v = *views;
  const double t = best_t(v);
  const bool at_infinity = std::isinf(t);
  const double at_b = at_infinity ? v.a : v.a * t + v.b;
  const double ct_d = at_infinity ? v.c : v.c * t + v.d;
  const Eigen::Vector3d line_1 =
      at_infinity ? Eigen::Vector3d(v.f1, 0, -1) : Eigen::Vector3d(t * v.f1, 1, -t);
  const Eigen::Vector3d line_2(-v.f2 * ct_d, at_b, ct_d);
  return CorrectedPair{
      .point_1 = (v.original_from_canonical_1 * closest_to_origin(line_1)).hnormalized(),
      .point_2 = (v.original_from_canonical_2 * closest_to_origin(line_2)).hnormalized(),
      .cost = at_infinity ? cost_at_infinity(v) : cost_at(v, t)};
}

geometry::InverseDepthPoint intersect(const geometry::Pose& cam2_from_cam1,
                                      const CorrectedPair& pair) {
  // (R x1 + w t) x x2 = 0 for the inverse depth w: the rays of HZ 12.2 without their singularity at
  // infinity.
  const Eigen::Vector3d ray_1 = cam2_from_cam1.rotation * pair.point_1.homogeneous();
  const Eigen::Vector3d ray_2 = pair.point_2.homogeneous();
  const Eigen::Vector3d moment = cam2_from_cam1.translation.cross(ray_2);
  return {pair.point_1, ray_2.cross(ray_1).dot(moment) / moment.squaredNorm()};
}

}  // namespace gazed::triangulation::methods
