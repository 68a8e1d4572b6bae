#include "agent/lab/explain/look_pair.hpp"

#include <cmath>

#include "agent/geometry/head.hpp"

namespace gazed::lab::explain {

namespace {

// Enough for a line that a lens bends.
constexpr int steps = 64;

/// In front of the camera or behind it.
geometry::Pixel image_of_centre(const geometry::CameraModel& camera,
                                const Eigen::Vector3d& centre_m) {
  if (centre_m.isZero()) return cycle::no_pixel();
  // Out of sight the lens's polynomial means nothing: it folds back.
  geometry::CameraModel pinhole = camera;
  if (!geometry::project(camera, centre_m) && !geometry::project(camera, -centre_m)) {
    pinhole.distortion = {};
  }
  const auto in_front = geometry::project(pinhole, centre_m);
  return in_front ? *in_front : geometry::project(pinhole, -centre_m).value_or(cycle::no_pixel());
}

PixelLine line_of(const geometry::CameraModel& camera, const geometry::Pose& other_from_this,
                  const geometry::Pixel& pixel, double nearest_m) {
  const auto direction = geometry::normalise(camera, pixel);
  PixelLine out;
  if (!direction) return out;
  const Eigen::Vector3d ray = direction->homogeneous().normalized();
  for (int i = 0; i <= steps; ++i) {
    const double inverse_range_per_m = i / (steps * nearest_m);
    // The point times its inverse range, so that infinity is a point too.
    const Eigen::Vector3d seen =
        other_from_this.rotation * ray + inverse_range_per_m * other_from_this.translation;
    if (const auto at = geometry::project(camera, seen)) out.push_back(*at);
  }
  return out;
}

}  // namespace

geometry::Pixel LookPair::epipole_in_later() const {
  return image_of_centre(camera, cam_from_cam1.translation);
}

geometry::Pixel LookPair::epipole_in_first() const {
  return image_of_centre(camera, cam_from_cam1.inverse().translation);
}

PixelLine LookPair::line_in_later(const geometry::Pixel& pixel_1, double nearest_m) const {
  return line_of(camera, cam_from_cam1, pixel_1, nearest_m);
}

PixelLine LookPair::line_in_first(const geometry::Pixel& pixel, double nearest_m) const {
  return line_of(camera, cam_from_cam1.inverse(), pixel, nearest_m);
}

double LookPair::angle_to_baseline_rad(const geometry::Pixel& pixel_1) const {
  const auto direction = geometry::normalise(camera, pixel_1);
  if (!direction) return triangulation::not_a_number;
  const Eigen::Vector3d ray = direction->homogeneous(), centre_m = geometry::origin(cam_from_cam1);
  return std::atan2(ray.cross(centre_m).norm(), std::abs(ray.dot(centre_m)));
}

std::optional<LookPair> pair_of(const cycle::Fixation& fixation, std::size_t look) {
  if (look == 0 || look >= fixation.look_count) return std::nullopt;
  const cycle::FixationLook &first = fixation.looks.front(), &later = fixation.looks[look];
  const bool refined = geometry::finite(first.refined) && geometry::finite(later.refined);
  const geometry::HeadAngles angles_1 = refined ? first.refined : first.measured;
  const geometry::HeadAngles angles = refined ? later.refined : later.measured;
  if (!geometry::finite(angles_1) || !geometry::finite(angles)) return std::nullopt;
  const geometry::HeadGeometry& head = fixation.robot.head;
  return LookPair{fixation.robot.camera, geometry::cam_from_torso(head, angles) *
                                             later.torso_1_from_torso.inverse() *
                                             geometry::cam_from_torso(head, angles_1).inverse()};
}

double epipole_distance_px(const LookPair& pair) {
  return (pair.epipole_in_later() - pair.epipole_in_first()).norm();
}

}  // namespace gazed::lab::explain
