#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "drivers/sim/scene.hpp"
#include "drivers/sim/world.hpp"

#include "picture.hpp"

namespace gazed::sim::box_test {
namespace {

using namespace testing;

World box_world(const std::string& keys) {
  const Scene scene = parse_scene(
      "[room]\nlamp_m = [0, 0, 9]\n[[target]]\nshape = \"box\"\nsize_m = [0.2, 0.1]\n"
      "depth_m = 0.3\ncentre_m = [1, 0, 0]\ntexture = { colour = [200, 200, 200] }\n" +
          keys,
      "box.toml");
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  return make_world(scene, 0, true_robot(scene, profile));
}

TEST(Box, HasItsFrontWhereItIsAndFourSidesBehindIt) {
  const World world = box_world("");
  const geometry::CameraModel camera = small_camera(false);
  ASSERT_EQ(world.surfaces.size(), 5U);
  const auto range_m = [&](const Eigen::Vector3d& eye_m, const Eigen::Vector3d& at_m) {
    geometry::Pose pose = looking(std::atan2(at_m.y() - eye_m.y(), at_m.x() - eye_m.x()), 0.0);
    pose.translation = -(pose.rotation * eye_m);
    const std::optional<Hit> met =
        hit(world, camera, pose, *geometry::project(camera, pose * at_m));
    return met ? met->range_m : 0.0;
  };
  EXPECT_NEAR(range_m({0, 0, 0}, {1.0, 0.09, 0.04}), std::hypot(1.0, 0.09, 0.04), 1e-9);
  EXPECT_EQ(range_m({0, 0, 0}, {1.0, 0.11, 0.0}), 0.0);
  // From the left the left side is seen, from above the top.
  EXPECT_NEAR(range_m({0.8, 0.5, 0}, {1.2, 0.1, 0.03}), std::hypot(0.4, 0.4, 0.03), 1e-9);
  EXPECT_NEAR(range_m({0.8, -0.5, 0}, {1.2, -0.1, 0.03}), std::hypot(0.4, 0.4, 0.03), 1e-9);
  EXPECT_NEAR(range_m({0.7, 0, 0.3}, {1.2, 0.05, 0.05}), std::hypot(0.5, 0.05, 0.25), 1e-9);
  EXPECT_NEAR(range_m({0.7, 0, -0.3}, {1.2, 0.05, -0.05}), std::hypot(0.5, 0.05, 0.25), 1e-9);
}

TEST(Box, FacesTurnedToTheLampAreBrighter) {
  const World world = box_world("shading = 0.5\n");
  const geometry::CameraModel camera = small_camera(false);
  geometry::Pose pose = looking(0.0, 0.3);
  pose.translation = -(pose.rotation * Eigen::Vector3d(0.6, 0.0, 0.2));
  const Picture picture = render(world, camera, pose);
  const auto grey_at = [&](const Eigen::Vector3d& at_m) {
    const geometry::Pixel pixel = *geometry::project(camera, pose * at_m);
    return picture.at(static_cast<int>(std::lround(pixel.x())),
                      static_cast<int>(std::lround(pixel.y())));
  };
  const Eigen::Vector3d to_lamp_from_top(-1.15, 0.0, 9.0 - 0.05), to_lamp(-1.0, 0.0, 9.0);
  EXPECT_NEAR(grey_at({1.1, 0.0, 0.05}), 200.0 * (0.5 + 0.5 * to_lamp_from_top.normalized().z()),
              1.0);
  EXPECT_NEAR(grey_at({1.0, 0.0, 0.0}), 200.0 * (0.5 - 0.5 * to_lamp.normalized().x()), 1.0);
}

}  // namespace
}  // namespace gazed::sim::box_test
