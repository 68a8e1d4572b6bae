#include "tests/benchmarks/accuracy_placing.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace gazed::benchmarks {

namespace {

bool inside(Region region, double elevation_rad) {
  switch (region) {
    case Region::frame:
      return true;
    case Region::level_or_below:
      return elevation_rad <= 0.0;
    case Region::above_level:
      break;
  }
  return elevation_rad > 0.0 && elevation_rad <= 0.3;
}

}  // namespace

Camera1::Camera1(const sim::TrueRobot& truth)
    : robot(truth),
      torso_from_cam(geometry::cam_from_torso(truth.head, geometry::HeadAngles{}).inverse()) {}

Eigen::Vector3d Camera1::direction(const geometry::Pixel& pixel) const {
  return torso_from_cam.rotation *
         geometry::normalise(robot.camera, pixel)->homogeneous().normalized();
}

Eigen::Vector3d draw_direction(base::Random& random, Region region, const Camera1& camera,
                               double radius_rad, double range_m) {
  const geometry::CameraModel& model = camera.robot.camera;
  const double border_px = 16.0 + 1.2 * model.focal_px.x() * radius_rad;
  while (true) {
    const double x = random.uniform(border_px, model.width_px - 1 - border_px);
    const double y = random.uniform(border_px, model.height_px - 1 - border_px);
    const Eigen::Vector3d direction = camera.direction(geometry::Pixel(x, y));
    const double bottom_z_m = camera.centre_m().z() + range_m * (direction.z() - radius_rad);
    if (inside(region, std::asin(direction.z())) && bottom_z_m > floor_z_m) return direction;
  }
}

Eigen::Vector3d draw_normal(base::Random& random, const Camera1& camera, double tilt_rad) {
  const Eigen::AngleAxisd yaw(tilt_rad * random.symmetric(), Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(tilt_rad * random.symmetric(), Eigen::Vector3d::UnitY());
  return yaw * (pitch * -camera.axis());
}

sim::PlacedPlane plane(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& normal,
                       std::array<double, 2> size_m, const sim::Texture& texture) {
  sim::PlacedPlane placed;
  placed.centre_m = centre_m;
  placed.normal = normal;
  placed.appearance.size_m = size_m;
  placed.appearance.texture = texture;
  return placed;
}

std::array<sim::PlacedPlane, 5> room_walls(double half_width_m, double ahead_m) {
  const double middle_m = 0.5 * ahead_m, middle_z_m = 0.5 * (floor_z_m + ceiling_z_m);
  const std::array<double, 2> side{2.0 * ahead_m + 6.0, ceiling_z_m - floor_z_m};
  const std::array<double, 2> flat{2.0 * half_width_m, 2.0 * ahead_m + 6.0};
  const Eigen::Vector3d left = Eigen::Vector3d::UnitY(), up = Eigen::Vector3d::UnitZ();
  return {plane({ahead_m, 0.0, middle_z_m}, -Eigen::Vector3d::UnitX(),
                {2.0 * half_width_m, side[1]}, {}),
          plane({middle_m, half_width_m, middle_z_m}, -left, side, {}),
          plane({middle_m, -half_width_m, middle_z_m}, left, side, {}),
          plane({middle_m, 0.0, floor_z_m}, up, flat, {}),
          plane({middle_m, 0.0, ceiling_z_m}, -up, flat, {})};
}

}  // namespace gazed::benchmarks
