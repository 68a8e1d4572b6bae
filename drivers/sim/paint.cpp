#include "drivers/sim/paint.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gazed::sim {

namespace {

constexpr double white = 255.0;
// Beyond this the pattern of a ball is squeezed too much to be seen: its rim.
constexpr double least_facing = 0.15;

/// By multiplications alone, which give the same bits everywhere.
double power(double base, int exponent) {
  double result = 1.0;
  for (; exponent > 0; exponent /= 2, base *= base)
    if (exponent % 2 != 0) result *= base;
  return result;
}

/// The mirrored lamp at a place of a surface, grey levels (Blinn 1977).
double highlight(const PlacedSurface& surface, const Eigen::Vector3d& at_m,
                 const Eigen::Vector3d& normal) {
  const Eigen::Vector3d to_eye = (surface.eye_m - at_m).normalized();
  const Eigen::Vector3d to_lamp = (surface.lamp_m - at_m).normalized();
  if (normal.dot(to_lamp) <= 0.0) return 0.0;
  const double facing = std::max(0.0, normal.dot((to_eye + to_lamp).normalized()));
  return surface.finish.gloss * white * power(facing, surface.finish.shininess);
}

void add_light(double grey_levels, std::span<Light> rgb) {
  for (Light& light : rgb) light = light_of(levels_of(light) + grey_levels);
}

/// The pattern lies on the ball as the stereographic projection has it: without a seam but at the
/// back, and without a sine.
std::array<Light, 3> paint_ball(const PlacedSurface& ball, const PlanePoint& point,
                                double footprint_m) {
  const double u = point.u_m / ball.half_width_m, v = point.v_m / ball.half_height_m;
  const double within = std::min(1.0, 0.999 / std::max(std::hypot(u, v), 1e-9));
  const Eigen::Vector3d on_disc_m = ball.seen_centre_m + within * point.u_m * ball.seen_right +
                                    within * point.v_m * ball.seen_down;
  // The disc's plane and the outline's radius give the ball's centre again.
  const double radius_m = ball.ball_radius_m;
  const double sunk_m =
      std::sqrt(std::max(0.0, radius_m * radius_m - ball.half_width_m * ball.half_width_m));
  const Eigen::Vector3d front = ball.seen_right.cross(ball.seen_down);
  const Eigen::Vector3d centre_m = ball.seen_centre_m - sunk_m * front;
  const Eigen::Vector3d ray = (on_disc_m - ball.eye_m).normalized();
  const Eigen::Vector3d to_eye = ball.eye_m - centre_m;
  const double along_m = -ray.dot(to_eye);
  const double depth_m =
      std::sqrt(std::max(0.0, radius_m * radius_m - (to_eye.squaredNorm() - along_m * along_m)));
  const Eigen::Vector3d at_m = ball.eye_m + (along_m - depth_m) * ray;
  const Eigen::Vector3d normal = (at_m - centre_m) / radius_m;

  const double across = normal.dot(ball.right), down = normal.dot(ball.down);
  const double ahead = std::max(normal.dot(ball.down.cross(ball.right)), -0.9);
  const double scale = 2.0 / (1.0 + ahead);
  const double facing = std::max(-normal.dot(ray), least_facing);
  std::array<Light, 3> rgb =
      ball.texture.sample({radius_m * scale * across, radius_m * scale * down},
                          static_cast<float>(footprint_m * scale / facing));
  const double lit = std::max(0.0, normal.dot((ball.lamp_m - at_m).normalized()));
  const double light = 1.0 - ball.finish.shading * (1.0 - lit);
  for (Light& channel : rgb) channel = light_of(light * levels_of(channel));
  if (ball.finish.gloss > 0.0) add_light(highlight(ball, at_m, normal), rgb);
  return rgb;
}

}  // namespace

std::array<Light, 3> paint(const PlacedSurface& surface, const PlanePoint& point,
                           double footprint_m) {
  if (surface.ball_radius_m > 0.0) return paint_ball(surface, point, footprint_m);
  const SurfacePoint on_surface{
      std::clamp(point.u_m, -surface.half_width_m, surface.half_width_m),
      std::clamp(point.v_m, -surface.half_height_m, surface.half_height_m)};
  std::array<Light, 3> rgb = surface.texture.sample(on_surface, static_cast<float>(footprint_m));
  if (surface.finish.gloss > 0.0) add_highlight(surface, on_surface, rgb);
  return rgb;
}

void add_highlight(const PlacedSurface& surface, const SurfacePoint& point, std::span<Light> rgb) {
  const Eigen::Vector3d at_m =
      surface.seen_centre_m + point.u_m * surface.right + point.v_m * surface.down;
  Eigen::Vector3d normal = surface.down.cross(surface.right);
  if (normal.dot(surface.eye_m - at_m) < 0.0) normal = -normal;
  add_light(highlight(surface, at_m, normal), rgb);
}

}  // namespace gazed::sim
