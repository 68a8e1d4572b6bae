// What a nao-v3's top camera sees of a dark disc on a wall 0.6 m before its torso, as 640x480 GREY.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

/// Yaw is positive to the left, pitch down, rad. Metres, in the torso frame.
inline void paint_disc_on_wall(double yaw_rad, double pitch_rad, std::vector<std::uint8_t>& grey) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Matrix3d turn(AngleAxisd(yaw_rad, Vector3d::UnitZ()) *
                             AngleAxisd(pitch_rad, Vector3d::UnitY()));
  const Vector3d eye = Vector3d(0.0, 0.0, 0.1265) + turn * Vector3d(0.0539, 0.0, 0.0679);
  for (int i = 0; i < 640 * 480; ++i) {
    const double left = (331.0 - i % 640) / 752.0, up = (253.0 - i / 640) / 752.0;
    const Vector3d ray = turn * Vector3d(1.0, left, up);
    const Vector3d at = eye + (0.6 - eye.x()) / ray.x() * ray;  // where it meets the wall
    const double from_edge_m = 0.03 - std::hypot(at.y(), at.z() - 0.2);
    const double disc = std::clamp(0.5 + from_edge_m / 8e-4, 0.0, 1.0);  // its edge: a pixel
    const double wall = 170.0 + 20.0 * std::sin(70.0 * at.y()) * std::sin(70.0 * at.z());
    grey[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>((1.0 - 0.9 * disc) * wall);
  }
}
