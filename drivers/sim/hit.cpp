#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "drivers/sim/world.hpp"

namespace gazed::sim {

namespace {

/// Along a ray: how far the surface is, and the depth of its outline.
struct Meeting {
  double surface_m = 0.0;
  double outline_m = 0.0;
};

std::optional<Meeting> meet_ball(const Surface& ball, const Eigen::Vector3d& start,
                                 const Eigen::Vector3d& ray) {
  const Eigen::Vector3d to_centre = ball.centre_m - start;
  const double along_m = ray.dot(to_centre), distance2_m2 = to_centre.squaredNorm();
  const double depth2_m2 =
      ball.half_width_m * ball.half_width_m - (distance2_m2 - along_m * along_m);
  if (depth2_m2 < 0.0 || along_m <= std::sqrt(depth2_m2)) return std::nullopt;
  return Meeting{along_m - std::sqrt(depth2_m2), distance2_m2 / along_m};
}

std::optional<Meeting> meet_plane(const Surface& surface, const Eigen::Vector3d& start,
                                  const Eigen::Vector3d& ray) {
  const Eigen::Vector3d normal = surface.down.cross(surface.right);
  const double range_m = normal.dot(surface.centre_m - start) / normal.dot(ray);
  if (!(range_m > 0.0) || !std::isfinite(range_m)) return std::nullopt;
  const Eigen::Vector3d offset = start + range_m * ray - surface.centre_m;
  const double u = offset.dot(surface.right) / surface.half_width_m;
  const double v = offset.dot(surface.down) / surface.half_height_m;
  const double radius = std::hypot(u, v);
  const bool inside = surface.shape == Shape::rectangle ? std::abs(u) <= 1.0 && std::abs(v) <= 1.0
                                                        : radius <= 1.0 && radius >= surface.hole;
  if (!inside) return std::nullopt;
  return Meeting{range_m, range_m};
}

}  // namespace

std::optional<Hit> hit(const World& world, const geometry::CameraModel& camera,
                       const geometry::Pose& cam_from_torso, const geometry::Pixel& pixel) {
  const std::optional<Eigen::Vector2d> n = geometry::normalise(camera, pixel);
  if (!n) return std::nullopt;
  const geometry::Pose torso_from_cam = cam_from_torso.inverse();
  const Eigen::Vector3d start = torso_from_cam.translation;
  const Eigen::Vector3d ray = torso_from_cam.rotation * n->homogeneous().normalized();
  std::optional<Hit> nearest;
  double nearest_m = 0.0;
  for (const Surface& surface : world.surfaces) {
    const std::optional<Meeting> met = surface.shape == Shape::ball
                                           ? meet_ball(surface, start, ray)
                                           : meet_plane(surface, start, ray);
    if (!met || (nearest && met->surface_m > nearest_m * (1.0 + same_plane))) continue;
    nearest_m = met->surface_m;
    nearest = Hit{met->outline_m, surface.target};
  }
  return nearest;
}

}  // namespace gazed::sim
