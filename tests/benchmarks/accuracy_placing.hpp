// Where things are put in the rooms of the accuracy benchmark: camera 1, directions in its view,
// planes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "agent/base/random.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/world.hpp"

#include "tests/benchmarks/accuracy_rows.hpp"

namespace gazed::benchmarks {

// The standing robot's torso above the floor: hip offset, thigh, tibia, foot (NAO
// documentation 2.1, "Links": 85 + 100 + 102.9 + 45.19 mm).
inline constexpr double floor_z_m = -0.333;
inline constexpr double ceiling_z_m = 2.2;

template <class T>
[[nodiscard]] T one_of(base::Random& random, std::span<const T> values) {
  return values[static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()))];
}

/// The true camera 1: where it is, and the ray through a pixel, torso frame.
struct Camera1 {
  sim::TrueRobot robot;
  geometry::Pose torso_from_cam;

  explicit Camera1(const sim::TrueRobot& truth);

  [[nodiscard]] const Eigen::Vector3d& centre_m() const { return torso_from_cam.translation; }
  [[nodiscard]] Eigen::Vector3d axis() const { return torso_from_cam.rotation.col(2); }
  [[nodiscard]] Eigen::Vector3d direction(const geometry::Pixel& pixel) const;
};

/// A direction in which a thing of this radius is seen whole, a saliency cell off the border, and
/// stands above the floor.
[[nodiscard]] Eigen::Vector3d draw_direction(base::Random& random, Region region,
                                             const Camera1& camera, double radius_rad,
                                             double range_m);

/// Towards the camera against its optical axis, turned by up to `tilt_rad` about two axes.
[[nodiscard]] Eigen::Vector3d draw_normal(base::Random& random, const Camera1& camera,
                                          double tilt_rad);

[[nodiscard]] sim::PlacedPlane plane(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& normal,
                                     std::array<double, 2> size_m, const sim::Texture& texture);

/// A room without paint: the walls ahead, to the left and to the right, floor, ceiling.
[[nodiscard]] std::array<sim::PlacedPlane, 5> room_walls(double half_width_m, double ahead_m);

}  // namespace gazed::benchmarks
