#include "agent/geometry/head.hpp"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <string_view>

#include "agent/geometry/robot.hpp"

namespace gazed::geometry::head_test {
namespace {

// A chain of four rotations and two translations under 0.2 m rounds at about 1e-16.
constexpr double rounding = 1e-14;
// The pinned camera centres have eight decimals.
constexpr double pinned_m = 1e-8;
// The pinned distances have two decimals of a millimetre.
constexpr double distance_m = 5e-6;

HeadGeometry head_of(std::string_view robot, CameraPosition position = CameraPosition::top) {
  return robot_profile(robot, position)->rig.head;
}

// The camera's axes in the torso frame.
Eigen::Vector3d right_axis(const Pose& cam_from_torso) {
  return cam_from_torso.rotation.row(0).transpose();
}
Eigen::Vector3d down_axis(const Pose& cam_from_torso) {
  return cam_from_torso.rotation.row(1).transpose();
}
Eigen::Vector3d optical_axis(const Pose& cam_from_torso) {
  return cam_from_torso.rotation.row(2).transpose();
}

TEST(Head, OpticalAxesAreThoseOfTheReport) {
  // Russcher 2011, eq. 4.1.
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
  EXPECT_EQ(cam_from_torso(HeadGeometry(), {}).rotation, expected);
}

// The centres are those of the corrected chain; the report's eq. 4.2, which swaps the axes and
// reverses the translations, gives others.
TEST(Head, CameraCentreOfV4AndLater) {
  for (const auto robot : {"nao-v4", "nao-v5", "nao-v6"}) {
    const HeadGeometry head = head_of(robot);
    const Eigen::Vector3d left_down = origin(cam_from_torso(head, {0.3, 0.2}));
    EXPECT_LT((left_down - Eigen::Vector3d(0.06704841, 0.02074050, 0.17720756)).norm(), pinned_m);
    const Eigen::Vector3d right_up = origin(cam_from_torso(head, {-1.0, -0.5}));
    EXPECT_LT((right_up - Eigen::Vector3d(0.01135296, -0.01768118, 0.21049643)).norm(), pinned_m);
  }
}

TEST(Head, CameraCentreStraightAheadIsNeckPlusMount) {
  const HeadGeometry head = head_of("nao-v6");
  const Eigen::Vector3d expected = head.neck_offset_m + head.mount_offset_m;
  EXPECT_LT((origin(cam_from_torso(head, {})) - expected).norm(), rounding);
}

TEST(Head, CameraCentreKeepsItsDistanceFromTheNeck) {
  struct Case {
    HeadGeometry head;
    double distance_m;
  };
  for (const Case& c : {Case{head_of("nao-v6"), 0.08658}, Case{head_of("nao-v3"), 0.08669},
                        Case{head_of("nao-v4", CameraPosition::bottom), 0.05372}}) {
    for (double yaw = -2.0; yaw <= 2.0; yaw += 0.25) {
      for (double pitch = -0.6; pitch <= 0.5; pitch += 0.1) {
        const Eigen::Vector3d centre = origin(cam_from_torso(c.head, {yaw, pitch}));
        EXPECT_NEAR((centre - c.head.neck_offset_m).norm(), c.distance_m, distance_m);
      }
    }
  }
}

TEST(Head, PositiveYawTurnsLeft) {
  const Pose pose = cam_from_torso(HeadGeometry(), {0.3, 0.0});
  EXPECT_LT((optical_axis(pose) - Eigen::Vector3d(std::cos(0.3), std::sin(0.3), 0)).norm(),
            rounding);
  EXPECT_LT((down_axis(pose) - Eigen::Vector3d(0, 0, -1)).norm(), rounding);
}

TEST(Head, PositivePitchLooksDown) {
  const Pose pose = cam_from_torso(HeadGeometry(), {0.0, 0.3});
  EXPECT_LT((optical_axis(pose) - Eigen::Vector3d(std::cos(0.3), 0, -std::sin(0.3))).norm(),
            rounding);
  EXPECT_LT((right_axis(pose) - Eigen::Vector3d(0, -1, 0)).norm(), rounding);
}

TEST(Head, PitchTurnsAboutTheAxisThatYawHasTurned) {
  const Pose pose = cam_from_torso(HeadGeometry(), {0.7, 0.3});
  const Eigen::Vector3d expected{std::cos(0.7) * std::cos(0.3), std::sin(0.7) * std::cos(0.3),
                                 -std::sin(0.3)};
  EXPECT_LT((optical_axis(pose) - expected).norm(), rounding);
  EXPECT_NEAR(right_axis(pose).z(), 0.0, rounding);  // the horizon stays level
}

TEST(Head, MountRotationIsRollThenPitchThenYaw) {
  HeadGeometry head;
  head.mount_rotation_rad = {0.1, 0.2, 0.3};
  const Pose pose = cam_from_torso(head, {});
  // Columns of Rz(yaw) Ry(pitch) Rx(roll), written out: its x axis is the optical axis, its y axis
  // points left.
  const double cr = std::cos(0.1), sr = std::sin(0.1), cp = std::cos(0.2), sp = std::sin(0.2),
               cy = std::cos(0.3), sy = std::sin(0.3);
  EXPECT_LT((optical_axis(pose) - Eigen::Vector3d(cy * cp, sy * cp, -sp)).norm(), rounding);
  const Eigen::Vector3d left{cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr};
  EXPECT_LT((right_axis(pose) + left).norm(), rounding);
}

TEST(Head, ZeroIsAddedToWhatTheSensorSays) {
  HeadGeometry head = head_of("nao-v6");
  const Pose expected = cam_from_torso(head, {0.31, 0.18});
  head.zero = {0.01, -0.02};
  const Pose pose = cam_from_torso(head, {0.3, 0.2});
  EXPECT_LT((pose.rotation - expected.rotation).norm(), rounding);
  EXPECT_LT((pose.translation - expected.translation).norm(), rounding);
}

TEST(Head, SameAnglesGiveTheIdentity) {
  for (const auto robot : robot_names) {
    const Pose pose = cam2_from_cam1(head_of(robot), {-1.0, 0.2}, {-1.0, 0.2});
    EXPECT_LT((pose.rotation - Eigen::Matrix3d::Identity()).norm(), rounding);
    EXPECT_LT(pose.translation.norm(), rounding);
  }
}

TEST(Head, RelativePoseTakesPointsFromOneViewToTheOther) {
  const HeadGeometry head = head_of("nao-v4", CameraPosition::bottom);
  const HeadAngles first{0.4, -0.1}, second{-0.2, 0.3};
  const Eigen::Vector3d point_in_torso{0.5, 0.2, 0.1};
  const Eigen::Vector3d in_cam1 = cam_from_torso(head, first) * point_in_torso;
  const Eigen::Vector3d in_cam2 = cam_from_torso(head, second) * point_in_torso;
  EXPECT_LT((cam2_from_cam1(head, first, second) * in_cam1 - in_cam2).norm(), rounding);
}

TEST(Head, BaselineOfASymmetricYawMove) {
  // 2 (58.71 cos p + 63.64 sin p) sin(D/2) mm for a yaw move D at downward pitch p.
  const HeadGeometry head = head_of("nao-v4");
  const Pose pose = cam2_from_cam1(head, {0.2, 0.3}, {-0.2, 0.3});
  const double expected_m =
      2.0 * (0.05871 * std::cos(0.3) + 0.06364 * std::sin(0.3)) * std::sin(0.2);
  EXPECT_NEAR(pose.translation.norm(), expected_m, rounding);
}

}  // namespace
}  // namespace gazed::geometry::head_test
