#include "agent/tracking/warp.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gazed::tracking {

Eigen::Matrix3d PatchMotion::plane_homography(const PatchWarp& warp) const {
  const Eigen::Vector2d& g = warp.slope_per_m;
  const Eigen::RowVector3d plane(g.x(), g.y(), warp.inverse_depth_per_m - g.dot(reference));
  return cam2_from_cam1.rotation + cam2_from_cam1.translation * plane;
}

Eigen::Matrix3d PatchMotion::homography(const PatchWarp& warp) const {
  const double size = std::exp(warp.log_scale);
  Eigen::Matrix3d scaling = Eigen::Matrix3d::Identity();
  scaling.topLeftCorner<2, 2>() *= size;
  scaling.topRightCorner<2, 1>() = (1.0 - size) * reference;
  return warp.turn * plane_homography(warp) * scaling;
}

std::optional<geometry::Pixel> PatchMotion::reference_in_view_2(const geometry::CameraModel& camera,
                                                                const PatchWarp& warp) const {
  return geometry::project(camera, homography(warp) * reference.homogeneous());
}

double PatchMotion::scale(const PatchWarp& warp) const {
  const Eigen::Matrix3d compensated =
      cam2_from_cam1.rotation.transpose() * warp.turn.transpose() * homography(warp);
  const double depth = (compensated * reference.homogeneous()).z();
  return std::sqrt(std::abs(compensated.determinant() / (depth * depth * depth)));
}

EpipolarSegment::EpipolarSegment(const PatchMotion& motion, const geometry::CameraModel& camera,
                                 double inverse_depth_min_per_m, double inverse_depth_max_per_m)
    : inverse_depth_min_(inverse_depth_min_per_m), inverse_depth_max_(inverse_depth_max_per_m) {
  for (int i = 0; i < knots; ++i) {
    PatchWarp warp;
    warp.inverse_depth_per_m = inverse_depth_at(i);
    const auto pixel = motion.reference_in_view_2(camera, warp);
    valid_ = valid_ && pixel.has_value() && pixel->allFinite();
    pixels_[static_cast<std::size_t>(i)] = pixel.value_or(geometry::Pixel::Zero());
  }
}

bool EpipolarSegment::any_inside(const geometry::CameraModel& camera, double margin_px) const {
  return std::any_of(pixels_.begin(), pixels_.end(), [&](const geometry::Pixel& pixel) {
    return camera.contains(pixel, -margin_px);
  });
}

EpipolarSegment::Nearest EpipolarSegment::nearest(const geometry::Pixel& pixel) const {
  Nearest best{0.0, std::numeric_limits<double>::infinity()};
  for (int i = 0; i + 1 < knots; ++i) {
    const Eigen::Vector2d along = knot(i + 1) - knot(i);
    const double length2 = along.squaredNorm();
    const double share =
        length2 > 0.0 ? std::clamp((pixel - knot(i)).dot(along) / length2, 0.0, 1.0) : 0.0;
    const double distance = (knot(i) + share * along - pixel).norm();
    if (distance < best.distance_px) best = {inverse_depth_at(i + share), distance};
  }
  return best;
}

std::optional<PatchWarp> warp_to(const PatchMotion& motion, const geometry::CameraModel& camera,
                                 const EpipolarSegment& segment, const geometry::Pixel& pixel) {
  const auto seen = geometry::normalise(camera, pixel);
  if (!seen) return std::nullopt;
  PatchWarp warp;
  warp.inverse_depth_per_m = segment.nearest(pixel).inverse_depth_per_m;
  const Eigen::Vector3d predicted = motion.plane_homography(warp) * motion.reference.homogeneous();
  warp.turn = geometry::rotation_between(predicted, seen->homogeneous());
  return warp;
}

}  // namespace gazed::tracking
