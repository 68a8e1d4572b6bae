// How a small patch of one view looks in another view of the same head.
//
// Let d1 = (n1, 1) be the ray of a pixel of view 1 in normalised coordinates and x2 = R x1 + t the
// relative pose. A point of a plane has an inverse depth that is linear in n1,
//   lambda(n1) = lambda0 + g (n1 - n0),
// with n0 the patch's reference point, and is seen in view 2 along
//   d2 = R d1 + t lambda(n1).
// Angle errors turn this ray a little: d2' = Q d2, Q near the identity. A wrong lambda0 (which
// angle errors also cause) shows as a wrong size when t has a part along the ray: n1 is first
// scaled about n0 by e^s. All in all a homography, d2' = Q (R + t (g, lambda0 - g n0)^T) S d1,
// exact for planes and right angles.
//
// What is inside the outline of a ball stands out of that plane towards the camera, which adds h c
// to lambda, with c that of Relief.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::tracking {

/// The unknowns of a patch's image in view 2.
struct PatchWarp {
  double inverse_depth_per_m = 0.0;                    // lambda0
  Eigen::Vector2d slope_per_m = {0.0, 0.0};            // g
  double log_scale = 0.0;                              // s
  double relief_per_m = 0.0;                           // h
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // Q
};

/// The two views and the reference point.
struct PatchMotion {
  geometry::Pose cam2_from_cam1;
  Eigen::Vector2d reference = Eigen::Vector2d::Zero();  // n0, normalised

  /// Maps (n1, 1) of a point of the plane to a multiple of (n2, 1).
  [[nodiscard]] Eigen::Matrix3d homography(const PatchWarp& warp) const;

  /// R + t (g, lambda0 - g n0)^T: the homography without Q and S.
  [[nodiscard]] Eigen::Matrix3d plane_homography(const PatchWarp& warp) const;

  /// Where the reference point appears in view 2. None when it is not in front of the camera.
  [[nodiscard]] std::optional<geometry::Pixel> reference_in_view_2(
      const geometry::CameraModel& camera, const PatchWarp& warp) const;

  /// Size in the rotation-compensated view 2 over size in view 1, at the reference point: the root
  /// of the factor by which areas grow.
  [[nodiscard]] double scale(const PatchWarp& warp) const;
};

/// Where the reference point may appear in view 2 with right angles: the epipolar line between two
/// inverse depths (a curve, with distortion).
class EpipolarSegment {
 public:
  /// A multiple of (n2, 1) of the point at the given inverse depth must be in front of the camera
  /// at both ends; otherwise valid() is false.
  EpipolarSegment(const PatchMotion& motion, const geometry::CameraModel& camera,
                  double inverse_depth_min_per_m, double inverse_depth_max_per_m);

  struct Nearest {
    double inverse_depth_per_m = 0.0;
    double distance_px = 0.0;
  };

  [[nodiscard]] bool valid() const { return valid_; }
  /// True when a point of it, moved by up to margin_px, is in the frame.
  [[nodiscard]] bool any_inside(const geometry::CameraModel& camera, double margin_px) const;
  /// The segment's point nearest to a pixel.
  [[nodiscard]] Nearest nearest(const geometry::Pixel& pixel) const;
  /// Places along it, from the smallest inverse depth to the largest, equally spaced in it.
  static constexpr int knots = 9;
  [[nodiscard]] const geometry::Pixel& knot(int i) const {
    return pixels_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] double inverse_depth_at(double knot) const {
    return inverse_depth_min_ + (inverse_depth_max_ - inverse_depth_min_) * knot / (knots - 1);
  }

 private:
  std::array<geometry::Pixel, knots> pixels_;
  double inverse_depth_min_, inverse_depth_max_;
  bool valid_ = true;
};

/// The warp that puts the reference point on `pixel` of view 2: the inverse depth from the nearest
/// point of the segment, the rest a turn. None where the distortion cannot be undone.
[[nodiscard]] std::optional<PatchWarp> warp_to(const PatchMotion& motion,
                                               const geometry::CameraModel& camera,
                                               const EpipolarSegment& segment,
                                               const geometry::Pixel& pixel);

}  // namespace gazed::tracking
