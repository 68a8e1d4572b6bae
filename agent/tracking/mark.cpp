#include "agent/tracking/mark.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gazed::tracking {

namespace {

// How far a mark may stand out of its object, relative to a mark on a ball. The outline need
// not be round: of a shaded ball the lit part may be all that was found.
constexpr double of_ball = 1.25;
// A thing in front is beyond that by this many sigmas and by this many pixels: the outline between
// two things may be off by more than its sigma says.
constexpr double sigmas = 4.0;
constexpr double least_displacement_px = 0.7;
// Errors of the head's angles move both alike: what is not on the line is something else.
constexpr double most_across_px = 2.0;

std::optional<geometry::Pixel> pixel_2_of(const Eigen::Vector2d& normalised_1,
                                          const PatchWarp& warp, const PatchMotion& motion,
                                          const geometry::CameraModel& camera) {
  return geometry::project(camera, motion.homography(warp) * normalised_1.homogeneous());
}

// Relative to the inverse depth of the object's outline.
double most_on_object(const Target& mark, const Target& object) {
  const Relief& relief = object.patch.relief;
  const double share =
      std::min(1.0, mark.object.moments().area_px2 / object.object.moments().area_px2);
  const double on_ball = relief.radius_rad() * (std::sqrt(1.0 - share) + relief.radius_rad());
  return of_ball * on_ball;
}

}  // namespace

bool is_in_front(const Target& mark, const PatchMatch& mark_seen, const ObjectSeen& object,
                 const geometry::CameraModel& camera) {
  const auto& [target, match, fit, motion] = object;
  PatchWarp nearer = fit.warp;
  const double most = most_on_object(mark, target);
  nearer.inverse_depth_per_m *= 1.0 + most;
  const auto on_object = pixel_2_of(mark.reference, fit.warp, motion, camera);
  const auto most_off = pixel_2_of(mark.reference, nearer, motion, camera);
  if (!on_object || !most_off) return false;
  const Eigen::Vector2d along_px = *most_off - *on_object;
  const double length_px = along_px.norm();
  if (!(length_px > 0.0)) return false;
  const Eigen::Vector2d along = along_px / length_px;
  const Eigen::Vector2d off_px = mark_seen.pixel_2 - *most_off;
  const double beyond_px = along.dot(off_px);
  if (!((off_px - beyond_px * along).norm() <= most_across_px)) return false;
  const double sigma_px =
      std::sqrt(along.dot((mark_seen.covariance_px2 + match.covariance_px2) * along));
  return beyond_px > std::max(least_displacement_px, sigmas * sigma_px);
}

}  // namespace gazed::tracking
