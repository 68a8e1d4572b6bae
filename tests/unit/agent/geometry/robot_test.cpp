#include "agent/geometry/robot.hpp"

#include <Eigen/Core>
#include <array>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace gazed::geometry::robot_test {
namespace {

struct Expected {
  std::string_view name;
  CameraPosition position;
  Eigen::Vector2d focal_px, centre_px;
  Eigen::Vector3d mount_offset_m;
  double mount_pitch_rad;
  double focal_sigma_px, centre_sigma_px, mount_rotation_sigma_rad;
  double readout_s, delay_s;
};

class Profile : public testing::TestWithParam<Expected> {};

TEST_P(Profile, IsTheTable) {
  const Expected& e = GetParam();
  const auto profile = robot_profile(e.name, e.position);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->name, e.name);
  EXPECT_EQ(profile->rig.camera.focal_px, e.focal_px);
  EXPECT_EQ(profile->rig.camera.centre_px, e.centre_px);
  EXPECT_EQ(profile->rig.head.mount_offset_m, e.mount_offset_m);
  EXPECT_EQ(profile->rig.head.mount_rotation_rad, Eigen::Vector3d(0.0, e.mount_pitch_rad, 0.0));
  EXPECT_EQ(profile->rig.uncertainty.focal_sigma_px, e.focal_sigma_px);
  EXPECT_EQ(profile->rig.uncertainty.centre_sigma_px, e.centre_sigma_px);
  EXPECT_EQ(profile->rig.uncertainty.mount_rotation_sigma_rad, e.mount_rotation_sigma_rad);
  EXPECT_EQ(profile->readout_s, e.readout_s);
  EXPECT_EQ(profile->delay_s, e.delay_s);
}

TEST_P(Profile, HasWhatAllVersionsShare) {
  const auto profile = robot_profile(GetParam().name, GetParam().position);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->rig.camera.width_px, 640);
  EXPECT_EQ(profile->rig.camera.height_px, 480);
  EXPECT_EQ(profile->rig.camera.distortion, (std::array<double, 5>{}));
  EXPECT_EQ(profile->rig.head.neck_offset_m, Eigen::Vector3d(0.0, 0.0, 0.1265));
  EXPECT_EQ(profile->rig.head.zero, HeadAngles());
  EXPECT_EQ(profile->rig.uncertainty.pixel_sigma_px, 0.3);
  EXPECT_EQ(profile->rig.uncertainty.encoder_sigma_rad, 0.001);
  EXPECT_EQ(profile->rig.uncertainty.zero_sigma_rad, 0.005);
  EXPECT_EQ(profile->rig.uncertainty.mount_offset_sigma_m, 0.002);
  EXPECT_EQ(profile->max_speed_rad_s, (HeadAngles{8.26797, 7.19407}));
}

// Top cameras: the table that the configuration's documentation prints. Bottom cameras: their own
// mounting and, on V4 and V5, their own calibration.
std::vector<Expected> expected_profiles() {
  using enum CameraPosition;
  const Eigen::Vector2d v3_focal{752, 752}, v3_centre{331, 253};
  const Eigen::Vector2d v6_focal{608, 608}, v6_centre{319.5, 239.5};
  const Eigen::Vector3d v4_top{0.05871, 0, 0.06364}, v4_bottom{0.05071, 0, 0.01774};
  return {
      {"nao-v3", top, v3_focal, v3_centre, {0.0539, 0, 0.0679}, 0, 2, 1.6, 0.02, 0, 0},
      {"nao-v3", bottom, v3_focal, v3_centre, {0.0488, 0, 0.02381}, 0.6981, 2, 1.6, 0.02, 0, 0},
      {"nao-v4", top, {557, 556}, {309.4, 230.6}, v4_top, 0.0209, 5, 4, 0.02, 0.034, -0.031},
      {"nao-v4",
       bottom,
       {558.6, 556.1},
       {308.9, 247.6},
       v4_bottom,
       0.6929,
       5,
       4,
       0.02,
       0.034,
       -0.031},
      {"nao-v5", top, {557, 556}, {309.4, 230.6}, v4_top, 0.0209, 5, 4, 0.02, 0.034, -0.031},
      {"nao-v5",
       bottom,
       {558.6, 556.1},
       {308.9, 247.6},
       v4_bottom,
       0.6929,
       5,
       4,
       0.02,
       0.034,
       -0.031},
      {"nao-v6", top, v6_focal, v6_centre, v4_top, 0.0209, 10, 8, 0.07, 0.037, 0.002},
      {"nao-v6", bottom, v6_focal, v6_centre, v4_bottom, 0.6929, 10, 8, 0.07, 0.045, -0.009},
  };
}

INSTANTIATE_TEST_SUITE_P(Robots, Profile, testing::ValuesIn(expected_profiles()),
                         [](const auto& test) {
                           std::string name(test.param.name.substr(4));
                           return name +
                                  (test.param.position == CameraPosition::top ? "top" : "bottom");
                         });

TEST(Robot, TopIsTheDefaultCamera) {
  EXPECT_EQ(robot_profile("nao-v6")->rig.head.mount_rotation_rad.y(), 0.0209);
}

TEST(Robot, EachVersionsCamerasHaveTheirDevices) {
  EXPECT_EQ(robot_profile("nao-v6", CameraPosition::top)->video.device, "/dev/video-top");
  EXPECT_EQ(robot_profile("nao-v6", CameraPosition::bottom)->video.device, "/dev/video-bottom");
  for (const std::string_view robot : {"nao-v3", "nao-v4", "nao-v5"}) {
    EXPECT_EQ(robot_profile(robot, CameraPosition::top)->video.device, "/dev/video0");
    EXPECT_EQ(robot_profile(robot, CameraPosition::bottom)->video.device, "/dev/video1");
  }
}

TEST(Robot, OnlyTheV6sCamerasFlipByTheirExtensionUnit) {
  for (const std::string_view robot : robot_names) {
    for (const CameraPosition position : {CameraPosition::top, CameraPosition::bottom}) {
      EXPECT_EQ(robot_profile(robot, position)->video.flips_by_extension_unit, robot == "nao-v6")
          << robot;
    }
  }
}

TEST(Robot, EveryNameHasBothCameras) {
  for (const auto name : robot_names) {
    EXPECT_TRUE(robot_profile(name, CameraPosition::top)) << name;
    EXPECT_TRUE(robot_profile(name, CameraPosition::bottom)) << name;
  }
}

TEST(Robot, UnknownNameHasNoProfile) {
  for (const auto name : {"", "nao", "nao-v2", "nao-v66", "NAO-V6", "nao-v6 "}) {
    EXPECT_FALSE(robot_profile(name)) << name;
  }
}

}  // namespace
}  // namespace gazed::geometry::robot_test
