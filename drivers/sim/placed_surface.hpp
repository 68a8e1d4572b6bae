// A surface as one pose of the camera sees it: which pixels see it, where on it, and how much
// of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "agent/geometry/pose.hpp"
#include "drivers/sim/texture.hpp"
#include "drivers/sim/world.hpp"

namespace gazed::sim {

/// A surface with its paint, seen from the current pose.
struct PlacedSurface {
  Shape shape = Shape::rectangle;
  double half_width_m = 0.0;
  double half_height_m = 0.0;
  double hole = 0.0;
  Eigen::Vector3d right, down, centre_m;  // torso frame, when the test starts
  Motion motion;
  TextureSampler texture;
  Finish finish;
  Eigen::Vector3d lamp_m;
  double ball_radius_m = 0.0;  // 0: flat
  // Of the current pose. A ball is drawn as the disc within its outline, which faces the camera.
  Eigen::Vector3d eye_m = Eigen::Vector3d::Zero();  // the camera's centre
  Eigen::Vector3d seen_right = Eigen::Vector3d::Zero(), seen_down = Eigen::Vector3d::Zero();
  Eigen::Vector3d seen_centre_m = Eigen::Vector3d::Zero();
  // For the normalised coordinates (x, y): plane_from_cam (x, y, 1) = (u, v, 1) / depth.
  Eigen::Matrix3d plane_from_cam = Eigen::Matrix3d::Zero();
  // The box of normalised coordinates that it is seen in; empty when it is not seen.
  Eigen::Array2d box_min = Eigen::Array2d::Zero();
  Eigen::Array2d box_max = Eigen::Array2d::Zero();
};

/// A pixel's normalised coordinates and their change to the next column and row.
struct Ray {
  Eigen::Vector2d at;
  Eigen::Vector2d next_column;
  Eigen::Vector2d next_row;
};

/// Where a pixel meets a surface's plane.
struct PlanePoint {
  double u_m = 0.0, v_m = 0.0;
  double inverse_depth = 0.0;  // 1/m; not positive: not in front of the camera
};

/// A surface's part of one pixel.
struct PixelLayer {
  const PlacedSurface* surface = nullptr;
  PlanePoint point;
  double coverage = 0.0;     // share of the pixel
  double footprint_m = 0.0;  // side of what the pixel sees on the surface
};

/// What a row of pixels sees between two of them.
struct OnlySurface {
  const PlacedSurface* surface = nullptr;  // nullptr: not a single one, or its border is near
  double footprint_m = 0.0;
  double depth_change = 0.0;  // from one to the other, a share of the greater depth
};

/// Prepares a surface for a pose, as it is `time_s` after the test's start.
void place(PlacedSurface& surface, const geometry::Pose& cam_from_torso, double time_s);

/// Where a ray through normalised coordinates meets a placed surface's plane.
[[nodiscard]] PlanePoint meet(const PlacedSurface& surface, double x, double y);

/// None where the surface covers nothing of the pixel.
[[nodiscard]] std::optional<PixelLayer> layer(const PlacedSurface& surface, const Ray& ray);

/// What is seen from one pixel of a row to another, of the candidates. Surfaces are convex and
/// inverse depth is linear along a row: what holds at both ends holds in between.
[[nodiscard]] OnlySurface only_surface(std::span<const PlacedSurface> surfaces,
                                       std::span<const std::uint8_t> candidates, const Ray& first,
                                       const Ray& last);

}  // namespace gazed::sim
