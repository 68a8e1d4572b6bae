// How far the surface of a ball stands out of the plane of its outline, towards the camera.
//
// In inverse depth, by that of the ball's centre: with r the sine of the angle that its radius is
// seen under, and s the distance from the middle of the outline, 1 at the outline, it is
// r (sqrt(1 - s^2) + r), to third order in r. What is seen at the outline itself is not the surface
// but the cone of rays that touch it, whose axis goes through the centre.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/object.hpp"

namespace gazed::tracking {

class Relief {
 public:
  /// None anywhere.
  Relief() = default;
  /// As if the object were a ball. Its outline is taken for the ellipse that has the object's
  /// moments. Lens distortion is left out.
  Relief(const ObjectMask& object, const geometry::CameraModel& camera);

  /// At a pixel inside the outline, by r; 0 outside.
  [[nodiscard]] double at(const geometry::Pixel& pixel) const {
    const Eigen::Vector2d off = pixel - centre_px_;
    const double depth2 = inside_ - off.dot(inverse_ * off);
    return depth2 > 0.0 ? std::sqrt(depth2) + radius_rad_ : 0.0;
  }
  /// r.
  [[nodiscard]] double radius_rad() const { return radius_rad_; }
  /// The outline is a circle's, in angles: a ball's, or that of a disc that faces the camera.
  [[nodiscard]] bool is_round() const { return is_round_; }

 private:
  double inside_ = 0.0;
  double radius_rad_ = 0.01;
  bool is_round_ = false;
  geometry::Pixel centre_px_ = geometry::Pixel::Zero();
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
};

}  // namespace gazed::tracking
