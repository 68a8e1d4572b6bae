// How a small patch of one view looks in another view of the same head.
//
// Let d1 = (n1, 1) be the ray of a pixel of view 1 in normalised coordinates and x2 = R x1 + t the
// relative pose. The inverse depth of a plane's points is linear in n1,
//   lambda(n1) = lambda0 + g (n1 - n0),
// where n0 is the patch's reference point. View 2 sees such a point along
//   d2 = R d1 + t lambda(n1).
// Angle errors turn this ray a little: d2' = Q d2, with Q near the identity. A wrong lambda0,
// another effect of angle errors, changes the size if t has a component along the ray, so n1 is
// first scaled about n0 by e^s. Together this is a homography, d2' = Q (R + t (g, lambda0 - g
// n0)^T) S d1, exact for planes and correct angles.
//
// Inside the outline of a ball, the surface stands out of that plane towards the camera. This adds
// h c to lambda, where c is the relief of relief.hpp.
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

  /// Maps (n1, 1) of a point in the plane to a multiple of (n2, 1).
  [[nodiscard]] Eigen::Matrix3d homography(const PatchWarp& warp) const;

  /// R + t (g, lambda0 - g n0)^T: the homography without Q and S.
  [[nodiscard]] Eigen::Matrix3d plane_homography(const PatchWarp& warp) const;

  /// Where the reference point appears in view 2. None if it is not in front of the camera.
  [[nodiscard]] std::optional<geometry::Pixel> reference_in_view_2(
      const geometry::CameraModel& camera, const PatchWarp& warp) const;

  /// Size in the rotation-compensated view 2 over size in view 1, at the reference point: the
  /// square root of the ratio of areas.
  [[nodiscard]] double scale(const PatchWarp& warp) const;
};

/// Where the reference point may appear in view 2 if the angles are correct: the epipolar line
/// between two inverse depths (a curve, with distortion).
class EpipolarSegment {
 public:
  /// The point must be in front of camera 2 at both inverse depths; otherwise valid() is false.
  EpipolarSegment(const PatchMotion& motion, const geometry::CameraModel& camera,
                  double inverse_depth_min_per_m, double inverse_depth_max_per_m);

  struct Nearest {
    double inverse_depth_per_m = 0.0;
    double distance_px = 0.0;
  };

  [[nodiscard]] bool valid() const { return valid_; }
  /// True if some point of it, moved by up to margin_px, is in the frame.
  [[nodiscard]] bool any_inside(const geometry::CameraModel& camera, double margin_px) const;
  /// The point of the segment nearest to a pixel.
  [[nodiscard]] Nearest nearest(const geometry::Pixel& pixel) const;
  /// Points along it, equally spaced in inverse depth, from the smallest to the largest.
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

/// The warp that puts the reference point on `pixel` of view 2: inverse depth from the nearest
/// point of the segment, the rest as a turn. None where the distortion cannot be inverted.
[[nodiscard]] std::optional<PatchWarp> warp_to(const PatchMotion& motion,
                                               const geometry::CameraModel& camera,
                                               const EpipolarSegment& segment,
                                               const geometry::Pixel& pixel);

}  // namespace gazed::tracking
