// One test of a scene as geometry: surfaces in the torso frame as they are when the test starts,
// and where a ray meets them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/sim/scene.hpp"

namespace gazed::sim {

/// Surfaces whose depths differ by less than this share lie in the same plane.
inline constexpr double same_plane = 1e-6;

/// A rectangle or an ellipse, perhaps with a hole, where (u, v) is at centre_m + u right + v down;
/// or a ball, of which right and down say how its pattern lies. A box is five rectangles.
struct Surface {
  Shape shape = Shape::rectangle;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();  // unit vectors, seen from the front
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  double half_width_m = 0.0;
  double half_height_m = 0.0;
  double hole = 0.0;  // of a disc, as a share of its size
  Texture texture;
  Finish finish;
  Motion motion;  // from centre_m
  bool target = false;

  /// Of length 1: a flat surface's front looks there, and the middle of a ball's pattern.
  [[nodiscard]] Eigen::Vector3d front() const;
};

/// Of surfaces in the same plane the later one lies on top.
struct World {
  std::vector<Surface> surfaces;
  std::array<double, 3> background{};
  Eigen::Vector3d lamp_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> target_in_torso;  // centre of the test's object, else of the first
                                                   // target
  Motion target_motion;                            // from there
};

/// What the simulated robot truly is: the profile with the scene's changes.
struct TrueRobot {
  geometry::CameraModel camera;
  geometry::HeadGeometry head;
};

/// Throws std::invalid_argument when the distortion cannot be undone everywhere in the image.
[[nodiscard]] TrueRobot true_robot(const Scene& scene, const geometry::RobotProfile& profile);

/// The number of tests, at least 1.
[[nodiscard]] std::size_t test_count(const Scene& scene);

/// Throws std::invalid_argument for a test whose object cannot be put where it should be.
[[nodiscard]] World make_world(const Scene& scene, std::size_t test, const TrueRobot& robot);

/// The world this long after the test's start: everything that moves has moved on, and stands
/// still.
[[nodiscard]] World world_at(World world, double time_s);

/// The point on a pixel's ray at the depth of the outline of what the ray meets: of a flat thing
/// that is the point itself; of a ball it is where the ray passes its centre, in the plane that
/// faces the camera.
struct Hit {
  double range_m = 0.0;  // from the camera's centre
  bool target = false;   // else a wall or another plane
};

/// The nearest surface on the ray of a pixel.
[[nodiscard]] std::optional<Hit> hit(const World& world, const geometry::CameraModel& camera,
                                     const geometry::Pose& cam_from_torso,
                                     const geometry::Pixel& pixel);

}  // namespace gazed::sim
