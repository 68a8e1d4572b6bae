#include "agent/tracking/rigidity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <vector>

#include "agent/geometry/robot.hpp"

#include "scene.hpp"

namespace gazed::tracking::rigidity_test {
namespace {

constexpr double noise_px = 0.1;
constexpr double angle_sigma_rad = 0.02;

struct RigidityTest : testing::Test {
  geometry::RobotProfile robot = *geometry::robot_profile("nao-v6");
  geometry::HeadAngles look_1{-0.1, 0.0}, look_2{0.15, 0.2};
  base::Random random{11};
  const double f = robot.camera.focal_px.mean();

  double uniform(double from, double to) { return random.uniform(from, to); }

  // Points 0.3 to 4 m away, as the two looks see them.
  std::vector<PointPair> pairs(std::size_t count) {
    const geometry::Pose motion = geometry::cam2_from_cam1(robot.head, look_1, look_2);
    std::vector<PointPair> made(count);
    for (PointPair& pair : made) {
      pair.normalised_1 = {uniform(-0.4, 0.4), uniform(-0.3, 0.3)};
      const Eigen::Vector3d point = pair.normalised_1.homogeneous() / uniform(0.25, 3.0);
      pair.normalised_2 = (motion * point).hnormalized() +
                          noise_px / f * Eigen::Vector2d(random.normal(), random.normal());
      pair.sigma = noise_px / f;
    }
    return made;
  }
  // Moves a pair off its epipolar line.
  void push(PointPair& pair, double by_px) const {
    const geometry::Pose motion = geometry::cam2_from_cam1(robot.head, look_1, look_2);
    const Eigen::Vector2d along =
        (motion.rotation * pair.normalised_1.homogeneous() + motion.translation).hnormalized() -
        (motion.rotation * pair.normalised_1.homogeneous()).hnormalized();
    pair.normalised_2 += by_px / f * Eigen::Vector2d(-along.y(), along.x()).normalized();
  }
};

TEST_F(RigidityTest, KeepsAStillRoomWithWrongAngles) {
  for (int trial = 0; trial < 20; ++trial) {
    auto all = pairs(60);
    const auto error = [&] { return angle_sigma_rad * random.normal(); };
    mark_rigid(robot.head, look_1 + geometry::HeadAngles{error(), error()},
               look_2 + geometry::HeadAngles{error(), error()}, angle_sigma_rad, all);
    const auto rigid = std::count_if(all.begin(), all.end(), [](auto& p) { return p.rigid; });
    EXPECT_GE(rigid, 54);
  }
}

TEST_F(RigidityTest, DropsWhatMoved) {
  constexpr double moved_px = 2.0;
  for (int trial = 0; trial < 20; ++trial) {
    auto all = pairs(50);
    for (std::size_t i = 0; i < 12; ++i) push(all[i], (i % 2 == 0 ? 1 : -1) * moved_px);
    mark_rigid(robot.head, look_1 + geometry::HeadAngles{0.015, -0.01}, look_2, angle_sigma_rad,
               all);
    const auto middle = all.begin() + 12;
    EXPECT_EQ(std::count_if(all.begin(), middle, [](auto& p) { return p.rigid; }), 0);
    EXPECT_GE(std::count_if(middle, all.end(), [](auto& p) { return p.rigid; }), 33);
  }
}

TEST_F(RigidityTest, TooFewOrNoBaselineToTell) {
  auto few = pairs(7);
  push(few[0], 30.0);
  mark_rigid(robot.head, look_1, look_2, angle_sigma_rad, few);
  EXPECT_TRUE(few[0].rigid);
  auto same = pairs(30);
  mark_rigid(robot.head, look_1, look_1, angle_sigma_rad, same);
  EXPECT_TRUE(std::all_of(same.begin(), same.end(), [](auto& p) { return p.rigid; }));
}

TEST_F(RigidityTest, NonFiniteAnglesMarkNothing) {
  auto all = pairs(30);
  mark_rigid(robot.head, {std::nan(""), 0.0}, look_2, angle_sigma_rad, all);
  EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](auto& p) { return p.rigid; }));
}

}  // namespace
}  // namespace gazed::tracking::rigidity_test
