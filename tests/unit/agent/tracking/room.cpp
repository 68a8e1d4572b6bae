#include "room.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "agent/geometry/robot.hpp"
#include "drivers/sim/render.hpp"
#include "drivers/sim/sensor.hpp"

namespace gazed::tracking {

namespace {

sim::Texture texture(Paint paint, std::uint32_t seed, double grey) {
  sim::Texture texture;
  texture.colour = {grey, grey, grey};
  texture.seed = seed;
  if (paint == Paint::natural) {
    texture.pattern = sim::Pattern::natural;
    texture.tile_m = 1.6;
    texture.contrast = 28.0;
  } else if (paint == Paint::checker) {
    texture.pattern = sim::Pattern::checker;
    texture.cell_m = 0.11 + 0.013 * (seed % 5);
    texture.colour_2 = {0.4 * grey, 0.4 * grey, 0.4 * grey};
  }
  return texture;
}

// A rectangle at `centre`, seen from `normal`'s side.
sim::Surface surface(const Eigen::Vector3d& centre, const Eigen::Vector3d& right,
                     const Eigen::Vector3d& down, double width_m, double height_m,
                     sim::Texture paint) {
  sim::Surface made;
  made.centre_m = centre;
  made.right = right.normalized();
  made.down = down.normalized();
  made.half_width_m = 0.5 * width_m;
  made.half_height_m = 0.5 * height_m;
  made.texture = std::move(paint);
  return made;
}

geometry::Rig nao_v6_with(std::array<double, 5> distortion) {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  rig.camera.distortion = distortion;
  return rig;
}

}  // namespace

RoomScene::RoomScene(Paint paint, std::uint32_t seed, std::array<double, 5> distortion)
    : rig(nao_v6_with(distortion)), renderer_(std::make_shared<sim::Renderer>(rig.camera)) {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto add = [&](const sim::Surface& made) { world.surfaces.push_back(made); };
  world.background = {128, 128, 128};
  add(surface({2.5, 0, 0.4}, -y, -z, 6.0, 4.0, texture(paint, seed, 130)));       // ahead
  add(surface({1.5, 1.4, 0.4}, x, -z, 6.0, 4.0, texture(paint, seed + 1, 150)));  // left
  add(surface({1.5, -1.8, 0.4}, -x, -z, 6.0, 4.0, texture(paint, seed + 2, 110)));
  add(surface({1.0, 0, -0.25}, -y, -x, 5.0, 1.6, texture(paint, seed + 3, 140)));  // table
  // Boxes, turned a little.
  add(surface({0.8, 0.35, 0.1}, {0.3, -1, 0}, -z, 0.3, 0.4, texture(paint, seed + 4, 120)));
  add(surface({1.4, -0.4, 0.2}, {-0.4, -1, 0}, -z, 0.5, 0.5, texture(paint, seed + 5, 160)));
  add(surface({0.45, -0.22, 0.05}, {0.2, -1, 0.1}, -z, 0.12, 0.16, texture(paint, seed + 6, 90)));
  sim::Texture red = texture(Paint::natural, seed + 7, 100);
  red.colour = {200, 40, 40};
  add(surface({0.46, 0.02, 0.18}, -y, -z, 0.06, 0.06, red));
}

RoomScene RoomScene::blank_wall() {
  RoomScene room(Paint::blank);
  sim::Surface object = room.world.surfaces.back();
  room.world.surfaces = {
      surface({0.6, 0, 0.2}, {0, -1, 0}, {0, 0, -1}, 6.0, 4.0, texture(Paint::blank, 1, 215)),
      object};
  return room;
}

Photo RoomScene::photo(geometry::HeadAngles true_angles, geometry::HeadAngles measured,
                       const Exposure& exposure) const {
  sim::CameraBehaviour behaviour;
  behaviour.format =
      exposure.format == base::PixelFormat::grey ? base::PixelFormat::rgb24 : exposure.format;
  behaviour.pixel_noise = exposure.noise_levels;
  behaviour.exposure = exposure.exposure;
  behaviour.blur_sigma_px = 0.5;
  const geometry::CameraModel& camera = rig.camera;
  renderer_->set_world(world);
  renderer_->set_pose(geometry::cam_from_torso(rig.head, true_angles));
  sim::Sensor sensor(camera.width_px, camera.height_px, behaviour, exposure.seed);
  std::vector<sim::Light> row(3 * static_cast<std::size_t>(camera.width_px));
  for (int y = 0; y < camera.height_px; ++y) {
    renderer_->render_row(y, row);
    sensor.add_row(row);
  }
  Photo photo{base::Image(camera.width_px, camera.height_px, exposure.format), measured};
  photo.image.assign(sensor.finish());
  return photo;
}

std::optional<geometry::Pixel> RoomScene::true_pixel(geometry::HeadAngles angles_1,
                                                     geometry::HeadAngles angles_2,
                                                     const geometry::Pixel& pixel_1,
                                                     double border_px) const {
  constexpr double same_range = 0.003;
  const geometry::CameraModel& camera = rig.camera;
  const geometry::Pose cam1 = geometry::cam_from_torso(rig.head, angles_1);
  const geometry::Pose cam2 = geometry::cam_from_torso(rig.head, angles_2);
  const auto hit_1 = sim::hit(world, camera, cam1, pixel_1);
  if (!hit_1) return std::nullopt;
  const Eigen::Vector3d ray = geometry::normalise(camera, pixel_1)->homogeneous().normalized();
  const Eigen::Vector3d in_cam2 = cam2 * (cam1.inverse() * (hit_1->range_m * ray));
  const auto pixel_2 = geometry::project(camera, in_cam2);
  if (!pixel_2 || !camera.contains(*pixel_2, border_px)) return std::nullopt;
  const auto hit_2 = sim::hit(world, camera, cam2, *pixel_2);
  if (!hit_2 || std::abs(hit_2->range_m - in_cam2.norm()) > same_range * in_cam2.norm()) {
    return std::nullopt;
  }
  return pixel_2;
}

std::optional<geometry::Pixel> RoomScene::seen_at_depth_of(geometry::HeadAngles angles_1,
                                                           geometry::HeadAngles angles_2,
                                                           const geometry::Pixel& pixel_1,
                                                           const geometry::Pixel& neighbour) const {
  const geometry::Pose cam1 = geometry::cam_from_torso(rig.head, angles_1);
  const auto hit_1 = sim::hit(world, rig.camera, cam1, neighbour);
  if (!hit_1) return std::nullopt;
  const Eigen::Vector3d ray = geometry::normalise(rig.camera, pixel_1)->homogeneous().normalized();
  return geometry::project(rig.camera, geometry::cam_from_torso(rig.head, angles_2) *
                                           (cam1.inverse() * (hit_1->range_m * ray)));
}

geometry::Pixel RoomScene::object_px(geometry::HeadAngles angles) const {
  return geometry::project(rig.camera, geometry::cam_from_torso(rig.head, angles) *
                                           world.surfaces.back().centre_m)
      .value();
}

}  // namespace gazed::tracking
