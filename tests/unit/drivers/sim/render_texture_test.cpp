// Textures are seen where the rays meet them.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "drivers/sim/render.hpp"

#include "picture.hpp"

namespace gazed::sim::render_texture_test {
namespace {

using testing::facing_surface;
using testing::looking;
using testing::Picture;
using testing::render;
using testing::small_camera;
using testing::tilted;
using testing::world_of;

TEST(Render, TexturesAreInTruePerspective) {
  // A picture whose grey is the place on the surface, on a plane seen at a slant.
  constexpr int size = 256;
  constexpr double tolerance = 0.6;  // grey levels: one is 1/256 of the surface
  std::vector<std::int16_t> samples;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (const int value : {x, y, 0}) samples.push_back(static_cast<std::int16_t>(64 * value));
  auto plane = tilted(facing_surface(Shape::rectangle, 0.6, 0.0, 0.0, 0.5, 0.5, 0.0), 0.8, 0.3);
  plane.texture.pattern = Pattern::image;
  plane.texture.image = std::make_shared<const MipMap>(size, size, 3, false, std::move(samples));
  for (const bool distorted : {false, true}) {
    const geometry::CameraModel camera = small_camera(distorted);
    const geometry::Pose pose = looking(0.05, -0.02);
    const Picture picture = render(world_of({plane}), camera, pose);
    int compared = 0;
    for (double u = -0.8; u <= 0.8; u += 0.1)
      for (double v = -0.8; v <= 0.8; v += 0.1) {
        const geometry::Pixel pixel = *geometry::project(
            camera, pose * (plane.centre_m + u * plane.half_width_m * plane.right +
                            v * plane.half_height_m * plane.down));
        if (!camera.contains(pixel, 3.0)) continue;
        const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
        const double fx = pixel.x() - x, fy = pixel.y() - y;
        const auto bilinear = [&](int c) {
          return (1 - fy) * ((1 - fx) * picture.at(x, y, c) + fx * picture.at(x + 1, y, c)) +
                 fy * ((1 - fx) * picture.at(x, y + 1, c) + fx * picture.at(x + 1, y + 1, c));
        };
        EXPECT_NEAR(bilinear(0), (0.5 + 0.5 * u) * size - 0.5, tolerance);
        EXPECT_NEAR(bilinear(1), (0.5 + 0.5 * v) * size - 0.5, tolerance);
        ++compared;
      }
    EXPECT_GT(compared, 100);
  }
}

TEST(Render, ASteepPlaneIsSeenWhereTheRaysMeetIt) {
  // A ramp keeps its value on every level of the map: what differs is the place. A pixel is up to
  // seven samples wide: this is a hundredth of it, and samples and light are rounded to 1/64, 1/32.
  constexpr double tolerance = 0.06;
  constexpr int size = 128;
  auto plane = facing_surface(Shape::rectangle, 0.3, 0.0, 0.0, 0.4, 1.0, 0.0);
  plane = tilted(plane, 1.35, 0.0);
  plane.texture.pattern = Pattern::image;
  plane.texture.image = testing::ramp(size, size);
  const geometry::CameraModel camera = small_camera(false);
  const geometry::Pose pose = looking(0.0, 0.0);
  const Picture picture = render(world_of({plane}), camera, pose);
  int compared = 0;
  for (int x = 0; x < camera.width_px; ++x) {
    const auto met = hit(world_of({plane}), camera, pose, geometry::Pixel(x, 60));
    if (!met) continue;
    const Eigen::Vector3d ray =
        geometry::normalise(camera, geometry::Pixel(x, 60))->homogeneous().normalized();
    const Eigen::Vector3d point_m = pose.inverse() * (met->range_m * ray).eval();
    const double u = (point_m - plane.centre_m).dot(plane.right) / plane.half_width_m;
    if (std::abs(u) > 0.8) continue;  // nothing of the border is in a pixel
    EXPECT_NEAR(static_cast<double>(picture.at(x, 60)), (0.5 + 0.5 * u) * size - 0.5, tolerance)
        << "column " << x;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

}  // namespace
}  // namespace gazed::sim::render_texture_test
