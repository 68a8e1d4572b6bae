#include "drivers/sim/world.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string_view>

namespace gazed::sim::world_test {
namespace {

constexpr double exact_m = 1e-12;

Scene scene_of(std::string_view text) {
  return parse_scene(text, "test.toml");
}

TrueRobot robot_of(const Scene& scene, std::string_view name = "nao-v6") {
  return true_robot(scene, *geometry::robot_profile(name));
}

geometry::Pose first_pose(const TrueRobot& robot) {
  return geometry::cam_from_torso(robot.head, geometry::HeadAngles{});
}

TEST(World, ReportTest1HasTheObjectAheadAtThirtyCentimetres) {
  const Scene scene = scene_of(default_scene_toml());
  for (const std::string_view name : geometry::robot_names) {
    const TrueRobot robot = robot_of(scene, name);
    const World world = make_world(scene, 0, robot);
    const Eigen::Vector3d target = first_pose(robot) * *world.target_in_torso;
    EXPECT_NEAR(target.z(), 0.30, exact_m);
    const geometry::Pixel pixel = *geometry::project(robot.camera, target);
    EXPECT_NEAR(pixel.x(), 319.5, 1e-9);
    EXPECT_NEAR(pixel.y(), 239.5, 1e-9);
    // The wall: along the optical axis, and square to it.
    const Hit corner = *hit(world, robot.camera, first_pose(robot), geometry::Pixel(3.0, 5.0));
    const Eigen::Vector3d ray =
        geometry::normalise(robot.camera, geometry::Pixel(3.0, 5.0))->homogeneous();
    EXPECT_FALSE(corner.target);
    EXPECT_NEAR(corner.range_m / ray.norm(), 0.30, exact_m);
    EXPECT_TRUE(hit(world, robot.camera, first_pose(robot), pixel)->target);
  }
}

TEST(World, ReportTest2HasTheWholeObjectInACorner) {
  const Scene scene = scene_of(default_scene_toml());
  for (const std::string_view name : geometry::robot_names) {
    const TrueRobot robot = robot_of(scene, name);
    const World world = make_world(scene, 1, robot);
    const Eigen::Vector3d target = first_pose(robot) * *world.target_in_torso;
    EXPECT_NEAR(target.z(), 0.30, exact_m);
    const geometry::Pixel pixel = *geometry::project(robot.camera, target);
    EXPECT_LT(pixel.x(), 640.0 / 4.0);
    EXPECT_LT(pixel.y(), 480.0 / 4.0);
    const double radius_px = 0.03 / 0.30 * robot.camera.focal_px.x();
    EXPECT_TRUE(robot.camera.contains(pixel, radius_px + 10.0));
  }
}

TEST(World, TargetTestsAtAPixelAndAtAPosition) {
  const Scene scene = scene_of(R"(
[[target_test]]
pixel = [100, 400]
range_m = 0.8
wall_gap_m = 0.2
[[target_test]]
position_m = [1.0, 0.2, 0.3]
wall = false
)");
  const TrueRobot robot = robot_of(scene);
  const World at_pixel = make_world(scene, 0, robot);
  EXPECT_NEAR(hit(at_pixel, robot.camera, first_pose(robot), geometry::Pixel(100, 400))->range_m,
              0.8, 1e-9);
  const Hit wall = *hit(at_pixel, robot.camera, first_pose(robot), geometry::Pixel(600, 20));
  EXPECT_FALSE(wall.target);
  EXPECT_GT(wall.range_m, 0.9);
  const World at_position = make_world(scene, 1, robot);
  EXPECT_EQ(*at_position.target_in_torso, Eigen::Vector3d(1.0, 0.2, 0.3));
  EXPECT_FALSE(hit(at_position, robot.camera, first_pose(robot), geometry::Pixel(600, 470)));
}

TEST(World, PlanesAndTargetsOfARoom) {
  const Scene scene = scene_of(R"(
[[plane]]
centre_m = [0, 0, -0.3]
normal = [0, 0, 1]
size_m = [10, 10]
[[target]]
centre_m = [0.5, 0.0, 0.2]
size_m = [0.1, 0.1]
mark = "cross"
)");
  const World world = make_world(scene, 0, robot_of(scene));
  ASSERT_EQ(world.surfaces.size(), 4U);  // floor, target and the two bars of its cross
  EXPECT_EQ(*world.target_in_torso, Eigen::Vector3d(0.5, 0.0, 0.2));
  for (const Surface& surface : world.surfaces) {
    EXPECT_NEAR(surface.right.norm(), 1.0, 1e-12);
    EXPECT_NEAR(surface.right.dot(surface.down), 0.0, 1e-12);
  }
  // Seen from above a floor's picture has its top ahead, its right side to the right.
  EXPECT_EQ(world.surfaces[0].right, -Eigen::Vector3d::UnitY());
  EXPECT_EQ(world.surfaces[0].down, -Eigen::Vector3d::UnitX());
  EXPECT_EQ(world.surfaces[1].right, -Eigen::Vector3d::UnitY());
  EXPECT_EQ(world.surfaces[1].down, -Eigen::Vector3d::UnitZ());
}

TEST(World, TheTruthDiffersFromTheProfileWhereTheSceneSaysSo) {
  const Scene scene = scene_of(R"(
[robot]
focal_px = [600, 601]
mount_rotation_rad = [0.01, -0.07, 0.02]
zero_rad = [0.01, -0.02]
)");
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  const TrueRobot robot = true_robot(scene, profile);
  EXPECT_EQ(robot.camera.focal_px, Eigen::Vector2d(600, 601));
  EXPECT_EQ(robot.camera.centre_px, profile.rig.camera.centre_px);
  EXPECT_EQ(robot.head.mount_rotation_rad, Eigen::Vector3d(0.01, -0.07, 0.02));
  EXPECT_EQ(robot.head.zero, (geometry::HeadAngles{0.01, -0.02}));
  EXPECT_EQ(robot.head.mount_offset_m, profile.rig.head.mount_offset_m);
}

TEST(World, AnotherImageSizeKeepsTheLens) {
  const Scene scene = scene_of("[camera]\nwidth_px = 320\nheight_px = 240\n");
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  const TrueRobot robot = true_robot(scene, profile);
  EXPECT_EQ(robot.camera.focal_px, 0.5 * profile.rig.camera.focal_px);
  // The middle of the image stays its middle.
  EXPECT_NEAR(robot.camera.centre_px.x(), (profile.rig.camera.centre_px.x() + 0.5) / 2.0 - 0.5,
              1e-12);
}

TEST(World, AnObjectLargerThanTheImageHasNoCorner) {
  const Scene scene = scene_of("[object]\nsize_m = [2, 2]\n[[report_test]]\nnumber = 2\n");
  EXPECT_THROW((void)make_world(scene, 0, robot_of(scene)), std::invalid_argument);
}

}  // namespace
}  // namespace gazed::sim::world_test
