#include "drivers/sim/world.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace gazed::sim {

namespace {

Eigen::Vector3d vector(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

/// Light that falls on a surface, of all that it could get.
double light_on(const Finish& finish, const Eigen::Vector3d& normal,
                const Eigen::Vector3d& to_lamp) {
  return 1.0 - finish.shading * (1.0 - std::max(0.0, normal.dot(to_lamp.normalized())));
}

Surface make_surface(const Appearance& appearance, const Eigen::Vector3d& centre_m,
                     const Eigen::Vector3d& normal, const Eigen::Vector3d& up) {
  Surface surface;
  surface.shape = appearance.shape;
  surface.centre_m = centre_m;
  surface.right = up.cross(normal);
  if (surface.right.norm() <
      1e-6 * up.norm() * normal.norm())  // a floor: its picture's up is ahead
    surface.right = Eigen::Vector3d::UnitX().cross(normal);
  if (surface.right.norm() < 1e-6 * normal.norm())
    surface.right = Eigen::Vector3d::UnitZ().cross(normal);
  surface.right.normalize();
  surface.down = -normal.normalized().cross(surface.right);
  surface.half_width_m = 0.5 * appearance.size_m[0];
  surface.half_height_m = 0.5 * appearance.size_m[1];
  surface.texture = appearance.texture;
  surface.finish = appearance.finish;
  return surface;
}

/// The sides of a box of which this is the front, and the front, in their light.
std::array<Surface, 5> faces_of_box(const Surface& base, double depth_m,
                                    const Eigen::Vector3d& lamp_m) {
  const Eigen::Vector3d front = base.front(), back_m = -0.5 * depth_m * front;
  const auto face = [&](const Eigen::Vector3d& offset_m, const Eigen::Vector3d& right,
                        const Eigen::Vector3d& down, double half_width_m, double half_height_m) {
    Surface side = base;
    side.shape = Shape::rectangle;
    side.centre_m += offset_m;
    side.right = right;
    side.down = down;
    side.half_width_m = half_width_m;
    side.half_height_m = half_height_m;
    side.texture.light *= light_on(base.finish, side.front(), lamp_m - side.centre_m);
    return side;
  };
  const Eigen::Vector3d across_m = base.half_width_m * base.right;
  const Eigen::Vector3d down_m = base.half_height_m * base.down;
  const double half_depth_m = 0.5 * depth_m;
  return {
      face(across_m + back_m, -front, base.down, half_depth_m, base.half_height_m),
      face(back_m - across_m, front, base.down, half_depth_m, base.half_height_m),
      face(back_m - down_m, base.right, front, base.half_width_m, half_depth_m),
      face(back_m + down_m, base.right, -front, base.half_width_m, half_depth_m),
      face(Eigen::Vector3d::Zero(), base.right, base.down, base.half_width_m, base.half_height_m)};
}

/// A box's faces; the mark, which is paint on the surface: further surfaces in its plane, inside
/// its border.
void add_with_mark(World& world, const Surface& base, const Appearance& appearance) {
  if (base.shape == Shape::box) {
    for (const Surface& face : faces_of_box(base, appearance.depth_m, world.lamp_m))
      world.surfaces.push_back(face);
  } else {
    world.surfaces.push_back(base);
  }
  if (appearance.mark == Mark::none) return;
  Surface mark = base;
  mark.texture = Texture{};
  mark.texture.colour = appearance.mark_colour;
  if (appearance.mark == Mark::ring) {
    mark.shape = Shape::disc;
    mark.hole = 0.75;
    mark.half_width_m *= 0.7;
    mark.half_height_m *= 0.7;
    world.surfaces.push_back(mark);
    return;
  }
  mark.shape = Shape::rectangle;
  mark.half_width_m = 0.6 * base.half_width_m;
  mark.half_height_m = 0.1 * base.half_height_m;
  world.surfaces.push_back(mark);
  mark.half_width_m = 0.1 * base.half_width_m;
  mark.half_height_m = 0.6 * base.half_height_m;
  world.surfaces.push_back(mark);
}

/// The ray of a pixel of camera 1 in the torso frame, its component along the optical axis 1.
struct View1 {
  const TrueRobot& robot;
  geometry::Pose torso_from_cam;

  [[nodiscard]] Eigen::Vector3d ray(const geometry::Pixel& pixel) const {
    const std::optional<Eigen::Vector2d> n = geometry::normalise(robot.camera, pixel);
    if (!n)
      throw std::invalid_argument("target_test.pixel: no ray through pixel (" +
                                  std::to_string(pixel.x()) + ", " + std::to_string(pixel.y()) +
                                  ")");
    return torso_from_cam.rotation * n->homogeneous();
  }
  [[nodiscard]] Eigen::Vector3d centre() const { return torso_from_cam.translation; }
  [[nodiscard]] Eigen::Vector3d axis() const { return torso_from_cam.rotation.col(2); }
  [[nodiscard]] Eigen::Vector3d up() const { return -torso_from_cam.rotation.col(1); }
};

geometry::Pixel image_centre(const geometry::CameraModel& camera) {
  return {0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)};
}

/// Whether all of a surface is seen, `border_px` inside the image.
bool whole_in_view(const Surface& surface, const View1& view, double border_px) {
  constexpr int points = 64;
  const geometry::Pose cam_from_torso = view.torso_from_cam.inverse();
  // A rectangle is judged by the circle through its corners.
  const double grow = surface.shape == Shape::rectangle ? std::numbers::sqrt2 : 1.0;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    const Eigen::Vector3d point =
        surface.centre_m + grow * (surface.half_width_m * std::cos(angle) * surface.right +
                                   surface.half_height_m * std::sin(angle) * surface.down);
    const std::optional<geometry::Pixel> pixel =
        geometry::project(view.robot.camera, cam_from_torso * point);
    if (!pixel || !view.robot.camera.contains(*pixel, border_px)) return false;
  }
  return true;
}

/// Report test 2: along the image's diagonal from the top left corner inwards, the first place on
/// the wall where the object is seen whole.
Eigen::Vector3d corner_position(const SceneTest& test, const View1& view) {
  const geometry::CameraModel& camera = view.robot.camera;
  const geometry::Pixel centre = image_centre(camera);
  const double border_px = 0.02 * camera.width_px;
  constexpr int steps = 200;
  for (int i = 0; i < steps; ++i) {
    const geometry::Pixel pixel = centre * (static_cast<double>(i) / steps);
    if (!geometry::normalise(camera, pixel)) continue;
    Eigen::Vector3d position_m = view.centre() + test.range_m * view.ray(pixel);
    const Surface object = make_surface(test.object, position_m, -view.axis(), view.up());
    if (whole_in_view(object, view, border_px)) return position_m;
  }
  throw std::invalid_argument(
      "report_test.range_m: the object of test 2 is larger than the image at " +
      std::to_string(test.range_m) + " m");
}

Eigen::Vector3d object_position(const SceneTest& test, const View1& view) {
  switch (test.placement) {
    case Placement::image_centre:
      return view.centre() + test.range_m * view.ray(image_centre(view.robot.camera));
    case Placement::image_corner:
      return corner_position(test, view);
    case Placement::pixel:
      return view.centre() + test.range_m * view.ray(test.pixel).normalized();
    case Placement::position:
      break;
  }
  return test.position_m;
}

}  // namespace

TrueRobot true_robot(const Scene& scene, const geometry::RobotProfile& profile) {
  TrueRobot robot{profile.rig.camera, profile.rig.head};
  geometry::CameraModel& camera = robot.camera;
  camera.width_px = scene.camera.width_px.value_or(camera.width_px);
  camera.height_px = scene.camera.height_px.value_or(camera.height_px);
  // The same lens over another number of pixels; (0, 0) is the centre of a pixel.
  const Eigen::Vector2d scale(static_cast<double>(camera.width_px) / profile.rig.camera.width_px,
                              static_cast<double>(camera.height_px) / profile.rig.camera.height_px);
  if (scale != Eigen::Vector2d::Ones()) {
    camera.focal_px = camera.focal_px.cwiseProduct(scale);
    camera.centre_px = (camera.centre_px.array() + 0.5) * scale.array() - 0.5;
  }
  const RobotTruth& truth = scene.robot;
  if (truth.focal_px) camera.focal_px = {(*truth.focal_px)[0], (*truth.focal_px)[1]};
  if (truth.centre_px) camera.centre_px = {(*truth.centre_px)[0], (*truth.centre_px)[1]};
  if (truth.distortion) camera.distortion = *truth.distortion;
  if (truth.neck_offset_m) robot.head.neck_offset_m = vector(*truth.neck_offset_m);
  if (truth.mount_offset_m) robot.head.mount_offset_m = vector(*truth.mount_offset_m);
  if (truth.mount_rotation_rad) robot.head.mount_rotation_rad = vector(*truth.mount_rotation_rad);
  if (truth.zero_rad) robot.head.zero = {(*truth.zero_rad)[0], (*truth.zero_rad)[1]};
  return robot;
}

std::size_t test_count(const Scene& scene) {
  return std::max<std::size_t>(scene.tests.size(), 1);
}

World make_world(const Scene& scene, std::size_t test_index, const TrueRobot& robot) {
  World world;
  world.background = scene.room.background;
  world.lamp_m = scene.room.lamp_m;
  for (const PlacedPlane& plane : scene.planes) {
    Surface surface = make_surface(plane.appearance, plane.centre_m, plane.normal, plane.up);
    surface.target = plane.target;
    surface.motion = plane.motion;
    if (plane.target && !world.target_in_torso) {
      world.target_in_torso = plane.centre_m;
      world.target_motion = plane.motion;
    }
    add_with_mark(world, surface, plane.appearance);
  }
  if (test_index >= scene.tests.size()) return world;

  const SceneTest& test = scene.tests[test_index];
  const View1 view{robot, geometry::cam_from_torso(robot.head, geometry::HeadAngles{}).inverse()};
  const Eigen::Vector3d position_m = object_position(test, view);
  if (test.wall) {
    // The wall is centred on the optical axis.
    const double depth_m = view.axis().dot(position_m - view.centre()) + test.wall_gap_m;
    const Eigen::Vector3d centre_m = view.centre() + depth_m * view.axis();
    add_with_mark(world, make_surface(scene.wall, centre_m, -view.axis(), view.up()), scene.wall);
  }
  Surface object = make_surface(test.object, position_m, -view.axis(), view.up());
  object.target = true;
  object.motion = test.motion;
  add_with_mark(world, object, test.object);
  world.target_in_torso = position_m;
  world.target_motion = test.motion;
  return world;
}

World world_at(World world, double time_s) {
  for (Surface& surface : world.surfaces) {
    surface.centre_m += surface.motion.way_m(time_s);
    surface.motion = Motion{};
  }
  if (world.target_in_torso) *world.target_in_torso += world.target_motion.way_m(time_s);
  world.target_motion = Motion{};
  return world;
}

Eigen::Vector3d Surface::front() const {
  return down.cross(right);
}

}  // namespace gazed::sim
