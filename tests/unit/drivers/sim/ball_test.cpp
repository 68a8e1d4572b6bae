// Balls: drawn and judged as spheres in perspective are.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>

#include "drivers/sim/world.hpp"

#include "picture.hpp"

namespace gazed::sim::ball_test {
namespace {

using namespace testing;

Surface ball(const Eigen::Vector3d& centre_m, double radius_m, double grey) {
  Surface surface =
      facing_surface(Shape::ball, 1.0, 0.0, 0.0, 2.0 * radius_m, 2.0 * radius_m, grey);
  surface.centre_m = centre_m;
  surface.finish.shading = 0.0;
  return surface;
}

/// Between the ray of a pixel and the ball's centre.
double angle_off(const geometry::CameraModel& camera, const Eigen::Vector3d& centre_in_cam,
                 const geometry::Pixel& pixel) {
  const Eigen::Vector3d ray = geometry::normalise(camera, pixel)->homogeneous();
  return std::atan2(ray.cross(centre_in_cam).norm(), ray.dot(centre_in_cam));
}

TEST(Ball, OutlineIsWhereRaysTouchTheSphere) {
  const geometry::CameraModel camera = small_camera(false);
  constexpr double radius_m = 0.05;
  // Off the axis, where the outline is an ellipse, and up close, where the rays touch the ball well
  // in front of its centre: the disc through the centre would be 0.7 px smaller there.
  for (const Eigen::Vector3d& centre_m :
       {Eigen::Vector3d(0.5, 0.0, 0.0), Eigen::Vector3d(0.5, 0.14, -0.08),
        Eigen::Vector3d(0.25, -0.04, 0.02)}) {
    const geometry::Pose pose = looking(0.0, 0.0);
    const Picture picture = render(world_of({ball(centre_m, radius_m, 200.0)}), camera, pose);
    const Eigen::Vector3d in_cam = pose * centre_m;
    const geometry::Pixel middle = *geometry::project(camera, in_cam);
    const double outline_rad = std::asin(radius_m / in_cam.norm());
    const int row = static_cast<int>(std::lround(middle.y()));
    for (const int y : {row - 5, row, row + 5}) {
      const auto x = static_cast<int>(std::lround(middle.x()));
      for (const int end : {0, picture.width_px - 1}) {
        const double edge_px = crossing(picture, y, std::min(x, end), std::max(x, end), 125.0F);
        const double off_rad = angle_off(camera, in_cam, geometry::Pixel(edge_px, y));
        constexpr double tolerance_px = 0.1;  // of the crossing between two pixels
        EXPECT_NEAR(off_rad, outline_rad, tolerance_px / camera.focal_px.x());
      }
    }
  }
}

TEST(Ball, TheTruthIsTheDepthOfItsCentre) {
  const geometry::CameraModel camera = small_camera(false);
  const geometry::Pose pose = looking(0.0, 0.0);
  const Eigen::Vector3d centre_m(0.5, 0.1, 0.05);
  Surface target = ball(centre_m, 0.1, 200.0);
  target.target = true;
  const World world =
      world_of({facing_surface(Shape::rectangle, 0.6, 0.0, 0.0, 9.0, 9.0, 90.0), target});
  const Eigen::Vector3d in_cam = pose * centre_m;
  const geometry::Pixel middle = *geometry::project(camera, in_cam);
  EXPECT_NEAR(hit(world, camera, pose, middle)->range_m, centre_m.norm(), 1e-9);
  for (int x = 0; x < camera.width_px; ++x) {
    const geometry::Pixel pixel(x, middle.y());
    const double off_rad = angle_off(camera, in_cam, pixel);
    const std::optional<Hit> met = hit(world, camera, pose, pixel);
    ASSERT_TRUE(met);
    EXPECT_EQ(met->target, off_rad < std::asin(0.1 / centre_m.norm()));
    if (met->target) {
      EXPECT_NEAR(met->range_m, centre_m.norm() / std::cos(off_rad), 1e-9);
    }
  }
}

TEST(Ball, WhatIsInFrontOfItHidesIt) {
  const geometry::CameraModel camera = small_camera(false);
  const geometry::Pose pose = looking(0.0, 0.0);
  const Surface far = ball({0.5, 0.0, 0.0}, 0.1, 200.0);
  // In front of the ball's surface, and between its surface and its centre, beside it.
  const Surface near = facing_surface(Shape::rectangle, 0.39, 0.0, 0.0, 0.05, 0.05, 100.0);
  const Picture picture = render(world_of({near, far}), camera, pose);
  const geometry::Pixel middle = *geometry::project(camera, pose * Eigen::Vector3d(0.5, 0.0, 0.0));
  const int x = static_cast<int>(middle.x()), y = static_cast<int>(middle.y());
  EXPECT_NEAR(picture.at(x, y), 100.0F, 0.1F);
  EXPECT_NEAR(picture.at(x, y - 15), 200.0F, 0.1F);
}

TEST(Ball, IsShadedByTheLampAndItsPatternTurnsWithIt) {
  const geometry::CameraModel camera = small_camera(false);
  Surface shaded = ball({0.5, 0.0, 0.0}, 0.1, 200.0);
  shaded.finish.shading = 1.0;
  World world = world_of({shaded});
  world.lamp_m = {0.5, 10.0, 0.0};  // from the left
  const Picture picture = render(world, camera, looking(0.0, 0.0));
  const auto y = static_cast<int>(0.5 * camera.height_px);
  const double centre_px = 0.5 * (camera.width_px - 1);
  const double radius_px = camera.focal_px.x() * 0.1 / std::sqrt(0.25 - 0.01);
  const auto at = [&](double share) {
    return picture.at(static_cast<int>(std::lround(centre_px + share * radius_px)), y);
  };
  EXPECT_GT(at(-0.8), 120.0F);
  EXPECT_LT(at(0.5), 5.0F);
  EXPECT_GT(at(-0.8), at(-0.4));
  EXPECT_GT(at(-0.4), at(-0.1));
  // Front half checkered: seen from the side, another part of the pattern.
  Surface chequered = ball({0.5, 0.0, 0.0}, 0.1, 200.0);
  chequered.texture.pattern = Pattern::checker;
  chequered.texture.colour_2 = {20, 20, 20};
  chequered.texture.cell_m = 0.05;
  const Picture front = render(world_of({chequered}), camera, looking(0.0, 0.0));
  const double before = front.at(static_cast<int>(centre_px) + 3, y - 3);
  const double after = front.at(static_cast<int>(centre_px) - 3, y - 3);
  EXPECT_GT(std::abs(before - after), 100.0);
}

}  // namespace
}  // namespace gazed::sim::ball_test
