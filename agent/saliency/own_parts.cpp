#include "agent/saliency/own_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "agent/saliency/inhibition.hpp"
#include "agent/saliency/map_rays.hpp"
#include "agent/saliency/pyramid.hpp"

namespace gazed::saliency {

namespace {

// Shoulders: the joints are ShoulderOffsetY = 98 mm and ShoulderOffsetZ = 100 mm from the torso's
// origin (manufacturer's documentation 2.1, "Links"; B-Human, robotDimensions.cfg, armOffset, the
// same from between the hips, 85 mm lower); the radius is B-Human 2024's (shoulderRadius).
//
// Chest: through the contour by which B-Human 2009 cuts the torso out of its pictures
// (bodyContour.cfg, from between the hips: 60, 17, 160; 53, 45, 160; 35, 58, 180 mm).
const std::array<Capsule, 3> body{{
    {{0.0, 0.098, 0.100}, {0.0, 0.098, 0.100}, 0.048},
    {{0.0, -0.098, 0.100}, {0.0, -0.098, 0.100}, 0.048},
    {{0.012, -0.020, 0.077}, {0.012, 0.020, 0.077}, 0.048},
}};

// Ankles are 50 mm from the middle (HipOffsetY, same page), toes 115 mm before them
// (bodyContour.cfg) in a robot that stands straight, without errors. A V6 that stood with bent
// knees and leant back by 4 to 9 degrees, its camera turned in its head, saw its toes where these
// would be 0.1 m further forward and the outer edges 0.2 m from the middle (five pictures,
// own_parts in photographs_test): nothing tells where the legs are, so what the feet may reach is
// taken.
constexpr double sole_m = -0.27, foot_radius_m = 0.06;
const std::array<Capsule, 3> feet{{
    {{0.0, 0.050, sole_m}, {0.230, 0.140, sole_m}, foot_radius_m},
    {{0.0, -0.050, sole_m}, {0.230, -0.140, sole_m}, foot_radius_m},
    {{0.230, -0.140, sole_m}, {0.230, 0.140, sole_m}, foot_radius_m},
}};

/// Whether the half-line from the origin along `ray` (length 1) meets the capsule. If the point
/// nearest to the capsule lies behind the origin, the origin is used.
bool meets(const Eigen::Vector3d& ray, const Capsule& capsule) {
  const Eigen::Vector3d along = capsule.to_m - capsule.from_m;
  const double length2 = along.squaredNorm(), slope = along.dot(ray),
               rise = capsule.from_m.dot(ray);
  // The point of the capsule's axis nearest to the ray's line; any if they are parallel.
  const double apart = length2 - slope * slope;
  const double share = apart > 0.0 ? (rise * slope - capsule.from_m.dot(along)) / apart : 0.0;
  const Eigen::Vector3d near = capsule.from_m + std::clamp(share, 0.0, 1.0) * along;
  const Eigen::Vector3d off = near - std::max(near.dot(ray), 0.0) * ray;
  return off.squaredNorm() <= capsule.radius_m * capsule.radius_m;
}

}  // namespace

std::span<const Capsule> body_parts() {
  return body;
}

std::span<const Capsule> standing_feet() {
  return feet;
}

OwnParts::OwnParts(const geometry::CameraModel& camera, bool with_body, bool with_feet)
    : rays_(rays_of_map(camera)),
      seen_(length_at_level(camera.width_px, map_level),
            length_at_level(camera.height_px, map_level)),
      beside_(seen_.width(), seen_.height()),
      kept_(rays_.size()) {
  if (with_body) parts_.insert(parts_.end(), body.begin(), body.end());
  if (with_feet) parts_.insert(parts_.end(), feet.begin(), feet.end());
  for (const Eigen::Vector3d& ray : rays_)
    if (ray.z() <= 1.0) half_angle_rad_ = std::max(half_angle_rad_, std::acos(ray.z()));
}

// Whether the capsule's bounding sphere and the cone of all rays may meet.
bool OwnParts::in_view(const Capsule& in_cam) const {
  const Eigen::Vector3d middle = (in_cam.from_m + in_cam.to_m) / 2.0;
  const double reach = (in_cam.to_m - in_cam.from_m).norm() / 2.0 + in_cam.radius_m;
  const double distance = middle.norm();
  if (distance <= reach) return true;
  return std::acos(middle.z() / distance) <= half_angle_rad_ + std::asin(reach / distance);
}

void OwnParts::mark(const Capsule& in_cam) {
  auto ray = rays_.begin();
  for (int y = 0; y < seen_.height(); ++y)
    for (int x = 0; x < seen_.width(); ++x, ++ray)
      if (meets(*ray, in_cam)) seen_.set(x, y);
}

std::span<const std::uint16_t> OwnParts::kept(const geometry::Pose& cam_from_torso) {
  std::ranges::fill(seen_.words(), BitPlane::Word{0});
  bool any = false;
  for (const Capsule& part : parts_) {
    const Capsule in_cam{cam_from_torso * part.from_m, cam_from_torso * part.to_m, part.radius_m};
    if (!in_view(in_cam)) continue;
    mark(in_cam);
    any = true;
  }
  if (!any || seen_.count() == 0) return {};
  dilate(seen_, beside_);
  auto share = kept_.begin();
  for (int y = 0; y < beside_.height(); ++y)
    for (int x = 0; x < beside_.width(); ++x, ++share)
      *share = beside_.at(x, y) ? 0 : static_cast<std::uint16_t>(all_kept);
  return kept_;
}

}  // namespace gazed::saliency
