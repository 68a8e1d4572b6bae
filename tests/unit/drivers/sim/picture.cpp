#include "picture.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::sim::testing {

Picture render(const World& world, const geometry::CameraModel& camera,
               const geometry::Pose& cam_from_torso) {
  Renderer renderer(camera);
  renderer.set_world(world);
  renderer.set_pose(cam_from_torso);
  Picture picture{camera.width_px, camera.height_px, {}};
  std::vector<Light> row(static_cast<std::size_t>(camera.width_px) * 3U);
  for (int y = 0; y < camera.height_px; ++y) {
    renderer.render_row(y, row);
    for (const Light light : row) picture.rgb.push_back(levels_of(light));
  }
  return picture;
}

std::shared_ptr<const MipMap> ramp(int width, int height) {
  std::vector<std::int16_t> samples;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        samples.push_back(static_cast<std::int16_t>(x * static_cast<int>(MipMap::sample_scale)));
  return std::make_shared<const MipMap>(width, height, 3, false, std::move(samples));
}

std::array<float, 3> look_up(const MipMap& map, double x, double y, float footprint) {
  std::array<std::int32_t, 3> values{};
  map.sample(Course(x), Course(y), footprint,
             std::span(values).first(static_cast<std::size_t>(map.channels())));
  std::array<float, 3> found{};
  for (std::size_t c = 0; c < found.size(); ++c)
    found[c] = static_cast<float>(values[c]) / MipMap::value_scale;
  return found;
}

geometry::Pixel centroid(const Picture& picture, float background) {
  double weight = 0.0;
  geometry::Pixel sum = geometry::Pixel::Zero();
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) {
      const double difference = static_cast<double>(picture.at(x, y)) - background;
      weight += difference;
      sum += difference * geometry::Pixel(x, y);
    }
  return sum / weight;
}

double crossing(const Picture& picture, int y, int x0, int x1, float level) {
  for (int x = x0; x < x1; ++x) {
    const float a = picture.at(x, y), b = picture.at(x + 1, y);
    if ((a < level) != (b < level)) return x + static_cast<double>((level - a) / (b - a));
  }
  return -1.0;
}

geometry::CameraModel small_camera(bool distorted) {
  geometry::CameraModel camera;
  camera.width_px = 160;
  camera.height_px = 120;
  camera.focal_px = {150.0, 152.0};
  camera.centre_px = {78.3, 61.1};
  if (distorted) camera.distortion = {-0.12, 0.05, 0.004, -0.003, 0.01};
  return camera;
}

Surface facing_surface(Shape shape, double ahead_m, double left_m, double up_m, double width_m,
                       double height_m, double grey) {
  Surface surface;
  surface.shape = shape;
  surface.centre_m = {ahead_m, left_m, up_m};
  surface.right = -Eigen::Vector3d::UnitY();
  surface.down = -Eigen::Vector3d::UnitZ();
  surface.half_width_m = 0.5 * width_m;
  surface.half_height_m = 0.5 * height_m;
  surface.texture.colour = {grey, grey, grey};
  return surface;
}

Surface tilted(Surface surface, double about_vertical_rad, double about_horizontal_rad) {
  const Eigen::Matrix3d turn =
      geometry::about_z(about_vertical_rad) * geometry::about_y(about_horizontal_rad);
  surface.right = turn * surface.right;
  surface.down = turn * surface.down;
  return surface;
}

World world_of(std::vector<Surface> surfaces) {
  World world;
  world.background = {dark, dark, dark};
  world.surfaces = std::move(surfaces);
  return world;
}

geometry::Pose looking(double yaw_rad, double pitch_rad) {
  return geometry::cam_from_torso(geometry::HeadGeometry{}, {yaw_rad, pitch_rad});
}

TemporaryFile::TemporaryFile(const std::string& name, const std::string& contents)
    : path_((std::filesystem::temp_directory_path() /
             ("gazed_sim_test_" + std::to_string(getpid()) + "_" + name))
                .string()) {
  std::ofstream(path_, std::ios::binary) << contents;
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace gazed::sim::testing
