#include "drivers/sim/placed_surface.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drivers/sim/coverage.hpp"

namespace gazed::sim {

namespace {

constexpr double near_m = 0.005;              // nothing nearer is drawn
constexpr double least_inverse_depth = 1e-4;  // 1/m: nothing farther is drawn

/// d(u, v) / d(column, row), m/px.
Eigen::Matrix2d plane_jacobian(const PlacedSurface& surface, const PlanePoint& point,
                               const Ray& ray) {
  const Eigen::Matrix3d& m = surface.plane_from_cam;
  Eigen::Matrix2d by_normalised;
  by_normalised << m(0, 0) - point.u_m * m(2, 0), m(0, 1) - point.u_m * m(2, 1),
      m(1, 0) - point.v_m * m(2, 0), m(1, 1) - point.v_m * m(2, 1);
  Eigen::Matrix2d by_pixel;
  by_pixel.col(0) = by_normalised * ray.next_column;
  by_pixel.col(1) = by_normalised * ray.next_row;
  return by_pixel / point.inverse_depth;
}

double footprint_m(const Eigen::Matrix2d& jacobian) {
  return std::sqrt(std::max(jacobian.col(0).squaredNorm(), jacobian.col(1).squaredNorm()));
}

/// The share of the pixel between two parallel edges, `below` and `above` away in the unit of the
/// coordinate whose change by pixel is `gradient`.
double band_coverage(double below, double above, const Eigen::RowVector2d& gradient) {
  const double steepness = gradient.norm();
  if (steepness <= 0.0) return below >= 0.0 && above >= 0.0 ? 1.0 : 0.0;
  const Eigen::RowVector2d normal = gradient / steepness;
  return half_plane_coverage(below / steepness, normal.x(), normal.y()) +
         half_plane_coverage(above / steepness, normal.x(), normal.y()) - 1.0;
}

/// The share of a pixel that a surface covers, its border taken as straight inside the pixel.
double coverage(const PlacedSurface& surface, const PlanePoint& point,
                const Eigen::Matrix2d& jacobian) {
  const double u = point.u_m / surface.half_width_m, v = point.v_m / surface.half_height_m;
  const Eigen::RowVector2d du = jacobian.row(0) / surface.half_width_m;
  const Eigen::RowVector2d dv = jacobian.row(1) / surface.half_height_m;
  if (surface.shape == Shape::rectangle)
    return band_coverage(1.0 + u, 1.0 - u, du) * band_coverage(1.0 + v, 1.0 - v, dv);
  const double radius = std::sqrt(u * u + v * v);
  if (radius < 1e-9) return surface.hole > 0.0 ? 0.0 : 1.0;
  const Eigen::RowVector2d d_radius = (u * du + v * dv) / radius;
  const double inner = surface.hole > 0.0 ? radius - surface.hole : 2.0 + radius;
  return std::max(band_coverage(inner, 1.0 - radius, d_radius), 0.0);
}

/// How a surface lies to a pixel, with a few pixels to spare.
struct Lie {
  bool inside = false;         // the pixel sees nothing of its border
  unsigned beyond = 0;         // the borders that the pixel lies beyond, one bit each
  double footprint_m = 0.0;    // where it is inside
  double inverse_depth = 0.0;  // 0: not in front of the camera
};

Lie lie_of(const PlacedSurface& surface, const Ray& ray) {
  const PlanePoint point = meet(surface, ray.at.x(), ray.at.y());
  if (!(point.inverse_depth > least_inverse_depth)) return {};
  const double footprint = footprint_m(plane_jacobian(surface, point, ray));
  const double border_m = 3.0 * footprint;
  const std::array<double, 4> within_m{
      surface.half_width_m - point.u_m, surface.half_width_m + point.u_m,
      surface.half_height_m - point.v_m, surface.half_height_m + point.v_m};
  Lie lie{surface.shape == Shape::rectangle, 0, footprint, point.inverse_depth};
  for (std::size_t i = 0; i < within_m.size(); ++i) {
    if (within_m[i] < border_m) lie.inside = false;
    if (within_m[i] < -border_m) lie.beyond |= 1U << i;
  }
  return lie;
}

/// Takes what is seen of a straight edge, from a to b in the camera's frame, into the box.
void add_edge(PlacedSurface& surface, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const auto add = [&surface](const Eigen::Vector3d& point) {
    const Eigen::Array2d seen_at = point.head<2>().array() / point.z();
    surface.box_min = surface.box_min.min(seen_at);
    surface.box_max = surface.box_max.max(seen_at);
  };
  if (a.z() >= near_m) add(a);
  if ((a.z() >= near_m) != (b.z() >= near_m)) add(a + (near_m - a.z()) / (b.z() - a.z()) * (b - a));
}

/// The disc through the points where rays from the camera touch the ball: the outline of both is
/// the same. False from inside the ball.
bool face_camera(PlacedSurface& ball, const Eigen::Vector3d& centre_m) {
  const Eigen::Vector3d to_eye = ball.eye_m - centre_m;
  const double distance2_m2 = to_eye.squaredNorm();
  const double radius2_m2 = ball.ball_radius_m * ball.ball_radius_m;
  if (distance2_m2 <= 1.01 * radius2_m2) return false;
  const double share = radius2_m2 / distance2_m2;
  ball.seen_centre_m = centre_m + share * to_eye;
  ball.half_width_m = ball.half_height_m = ball.ball_radius_m * std::sqrt(1.0 - share);
  const Eigen::Vector3d front = to_eye.normalized();
  Eigen::Vector3d right = ball.down.cross(front);
  if (right.squaredNorm() < 1e-6) right = ball.right.cross(front);
  ball.seen_right = right.normalized();
  ball.seen_down = front.cross(ball.seen_right);
  return true;
}

}  // namespace

PlanePoint meet(const PlacedSurface& surface, double x, double y) {
  const Eigen::Matrix3d& m = surface.plane_from_cam;
  const double inverse_depth = m(2, 0) * x + m(2, 1) * y + m(2, 2);
  const double depth = 1.0 / inverse_depth;
  return {(m(0, 0) * x + m(0, 1) * y + m(0, 2)) * depth,
          (m(1, 0) * x + m(1, 1) * y + m(1, 2)) * depth, inverse_depth};
}

std::optional<PixelLayer> layer(const PlacedSurface& surface, const Ray& ray) {
  const PlanePoint point = meet(surface, ray.at.x(), ray.at.y());
  if (!(point.inverse_depth > least_inverse_depth)) return std::nullopt;
  const Eigen::Matrix2d jacobian = plane_jacobian(surface, point, ray);
  const double share = coverage(surface, point, jacobian);
  if (!(share > 0.0)) return std::nullopt;
  return PixelLayer{&surface, point, share, footprint_m(jacobian)};
}

OnlySurface only_surface(std::span<const PlacedSurface> surfaces,
                         std::span<const std::uint8_t> candidates, const Ray& first,
                         const Ray& last) {
  OnlySurface nearest;
  std::array<double, 2> depths{};
  bool whole = true;
  // Front surfaces mostly come last: in one plane the later is on top.
  for (std::size_t i = candidates.size(); i-- > 0 && whole;) {
    const PlacedSurface& surface = surfaces[candidates[i]];
    const Lie a = lie_of(surface, first), b = lie_of(surface, last);
    const bool seen = a.inverse_depth > 0.0 || b.inverse_depth > 0.0;
    if (!seen || (a.beyond & b.beyond) != 0) continue;
    const auto behind = [&](double share) {
      return nearest.surface != nullptr && a.inverse_depth > 0.0 && b.inverse_depth > 0.0 &&
             a.inverse_depth * share < depths[0] && b.inverse_depth * share < depths[1];
    };
    if (behind(1.0 - same_plane)) continue;
    const bool in_front =
        nearest.surface == nullptr || (a.inverse_depth > depths[0] * (1.0 + same_plane) &&
                                       b.inverse_depth > depths[1] * (1.0 + same_plane));
    whole = a.inside && b.inside && in_front;
    depths = {a.inverse_depth, b.inverse_depth};
    const auto [farther, nearer] = std::minmax(a.inverse_depth, b.inverse_depth);
    nearest = {&surface, b.footprint_m, 1.0 - farther / nearer};
  }
  return whole ? nearest : OnlySurface{};
}

void place(PlacedSurface& surface, const geometry::Pose& cam_from_torso, double time_s) {
  surface.eye_m = geometry::origin(cam_from_torso);
  const Eigen::Vector3d centre_m = surface.centre_m + surface.motion.way_m(time_s);
  surface.seen_right = surface.right;
  surface.seen_down = surface.down;
  surface.seen_centre_m = centre_m;
  const bool outside = surface.ball_radius_m == 0.0 || face_camera(surface, centre_m);
  const Eigen::Vector3d right = cam_from_torso.rotation * surface.seen_right;
  const Eigen::Vector3d down = cam_from_torso.rotation * surface.seen_down;
  const Eigen::Vector3d centre = cam_from_torso * surface.seen_centre_m;
  surface.box_min.setConstant(std::numeric_limits<double>::infinity());
  surface.box_max.setConstant(-std::numeric_limits<double>::infinity());
  Eigen::Matrix3d cam_from_plane;
  cam_from_plane << right, down, centre;
  // The determinant is the camera's distance from the plane.
  if (!outside || std::abs(cam_from_plane.determinant()) < 1e-6) return;
  surface.plane_from_cam = cam_from_plane.inverse();
  const Eigen::Vector3d u = surface.half_width_m * right, v = surface.half_height_m * down;
  const std::array<Eigen::Vector3d, 4> corners{centre - u - v, centre + u - v, centre + u + v,
                                               centre - u + v};
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_edge(surface, corners[i], corners[(i + 1) % corners.size()]);
}

}  // namespace gazed::sim
