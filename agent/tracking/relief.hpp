// How far the surface of a ball stands out of the plane of its outline, towards the camera.
//
// As a fraction of the inverse depth of the centre it is r (sqrt(1 - s^2) + r), to third order in
// r, where r is the sine of the angular radius and s the distance from the middle of the outline, 1
// at the outline. The outline itself shows not the surface but the cone of rays that touch it; the
// axis of that cone passes through the centre.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/object.hpp"

namespace gazed::tracking {

class Relief {
 public:
  /// No relief anywhere.
  Relief() = default;
  /// As if the object were a ball. Its outline is approximated by the ellipse with the object's
  /// moments. Lens distortion is ignored.
  Relief(const ObjectMask& object, const geometry::CameraModel& camera);

  /// At a pixel inside the outline, in units of r; 0 outside.
  [[nodiscard]] double at(const geometry::Pixel& pixel) const {
    const Eigen::Vector2d off = pixel - centre_px_;
    const double depth2 = inside_ - off.dot(inverse_ * off);
    return depth2 > 0.0 ? std::sqrt(depth2) + radius_rad_ : 0.0;
  }
  /// r, the sine of the angular radius.
  [[nodiscard]] double radius_rad() const { return radius_rad_; }
  /// True if the outline is a circle in angles: that of a ball, or of a disc that faces the camera.
  [[nodiscard]] bool is_round() const { return is_round_; }

 private:
  double inside_ = 0.0;
  double radius_rad_ = 0.01;
  bool is_round_ = false;
  geometry::Pixel centre_px_ = geometry::Pixel::Zero();
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
};

}  // namespace gazed::tracking
