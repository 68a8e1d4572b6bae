// Where a point of view 1 may be seen after a turn, and how a patch around it looks there.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::tracking {

/// Where a ray of view 1 is seen in view 2, from infinity to the nearest point. It is taken as
/// straight: distortion bends it by less than the search allows for.
class Prediction {
 public:
  /// None if the point at infinity is not within `margin_px` of view 2's frame. The near end is
  /// moved towards infinity until it is within it.
  [[nodiscard]] static std::optional<Prediction> make(const geometry::CameraModel& camera,
                                                      const geometry::Pose& cam2_from_cam1,
                                                      const Eigen::Vector2d& normalised_1,
                                                      double inverse_depth_max_per_m,
                                                      double margin_px);

  [[nodiscard]] const geometry::Pixel& far_px() const { return far_px_; }
  /// From the far end to the near end.
  [[nodiscard]] Eigen::Vector2d span_px() const { return near_px_ - far_px_; }
  /// Inverse depth, in view 1, of the point seen at this share of the way from the far to the near
  /// end.
  [[nodiscard]] double inverse_depth_at(double share) const;

 private:
  geometry::Pixel far_px_ = geometry::Pixel::Zero(), near_px_ = geometry::Pixel::Zero();
  double far_z_ = 1.0, near_z_ = 1.0;  // of the rays d2 = R (n1, 1) + t lambda
  double inverse_depth_max_per_m_ = 0.0;
};

/// d pixel_2 / d pixel_1 around a point at this inverse depth on a surface perpendicular to view
/// 1's optical axis.
[[nodiscard]] Eigen::Matrix2d pixel_2_by_pixel_1(const geometry::CameraModel& camera,
                                                 const geometry::Pose& cam2_from_cam1,
                                                 const Eigen::Vector2d& normalised_1,
                                                 double inverse_depth_per_m);

}  // namespace gazed::tracking
