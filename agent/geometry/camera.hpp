// The camera model: pinhole with Brown-Conrady distortion (Brown 1966; OpenCV's k1 k2 p1 p2 k3).
//
// Normalised coordinates are those of the plane z = 1 in the optical frame, undistorted. Pixel
// (0,0) is the centre of the top left pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace gazed::geometry {

using Pixel = Eigen::Vector2d;

struct CameraModel {
  int width_px = 640;
  int height_px = 480;
  Eigen::Vector2d focal_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  std::array<double, 5> distortion{};  // k1, k2, p1, p2, k3; no unit

  [[nodiscard]] bool contains(const Pixel& pixel, double border_px = 0.0) const {
    return pixel.x() >= border_px && pixel.y() >= border_px &&
           pixel.x() <= width_px - 1 - border_px && pixel.y() <= height_px - 1 - border_px;
  }
};

/// K, the calibration matrix.
[[nodiscard]] Eigen::Matrix3d calibration_matrix(const CameraModel& camera);

/// Where the ray through `pixel` meets z = 1. None when the distortion cannot be undone there (no
/// convergence, or only beyond the radius where the lens polynomial folds back) or the pixel is not
/// finite.
[[nodiscard]] std::optional<Eigen::Vector2d> normalise(const CameraModel& camera,
                                                       const Pixel& pixel);

/// Whether the lens polynomial has not folded back within this radius. `project` refuses points
/// beyond, and no pixel has its ray there.
[[nodiscard]] bool invertible_within(const CameraModel& camera, double radius);

/// The pixel of a point of the plane z = 1. Any point: beyond the fold of the lens polynomial the
/// pixel means nothing, and `project` refuses.
[[nodiscard]] Pixel pixel_of(const CameraModel& camera, const Eigen::Vector2d& normalised);

/// d pixel / d normalised, 2x2, px.
[[nodiscard]] Eigen::Matrix2d pixel_jacobian(const CameraModel& camera,
                                             const Eigen::Vector2d& normalised);

/// The pixel of a point in the optical frame, metres. None when it is not in front of the camera or
/// so far off the axis that the lens polynomial has folded back (it would appear at a wrong pixel).
[[nodiscard]] std::optional<Pixel> project(const CameraModel& camera,
                                           const Eigen::Vector3d& point_in_cam);

}  // namespace gazed::geometry
