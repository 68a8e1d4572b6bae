#include "agent/tracking/slopes.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace gazed::tracking {

namespace {

// Slopes may differ between looks by what changes the patch's size by this share. The outlines of
// balls and noise in small patches change it by a twentieth.
constexpr double squeeze_max = 0.1;
// Cosine of the angle between the ray and the surface's normal: 53 degrees.
constexpr double steep_cosine = 0.6;
// For anything farther, angle errors hide the depth.
constexpr double inverse_depth_min_per_m = 1.0;

bool is_steep(const PatchWarp& warp, const Eigen::Vector2d& reference) {
  const double inverse_depth = std::hypot(warp.inverse_depth_per_m, inverse_depth_min_per_m);
  const Eigen::Vector2d& slope = warp.slope_per_m;
  const Eigen::Vector3d normal(slope.x(), slope.y(), inverse_depth - slope.dot(reference));
  return inverse_depth < steep_cosine * normal.norm() * reference.homogeneous().norm();
}

}  // namespace

bool BelievedSlopes::believe(const PatchWarp& warp, const PatchMotion& motion) {
  const double baseline_m = motion.cam2_from_cam1.translation.norm();
  const auto is_like = [&](const Eigen::Vector2d& other) {
    return baseline_m * (warp.slope_per_m - other).norm() < squeeze_max;
  };
  if (count_ > 0) {
    const auto before = std::span(believed_).first(count_);
    if (!std::any_of(before.begin(), before.end(), is_like)) return false;
  } else if (is_steep(warp, motion.reference) && !(steep_ && is_like(*steep_))) {
    steep_ = warp.slope_per_m;
    return false;
  }
  if (count_ < looks_kept) believed_[count_++] = warp.slope_per_m;
  return true;
}

}  // namespace gazed::tracking
