// What the simulated robot's camera sees while the head or an object moves.
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>

#include "drivers/sim/sim_robot.hpp"

#include "robot_in.hpp"

namespace gazed::sim::sim_robot_motion_test {
namespace {

using testing::one_test;
using testing::red_centre;
using testing::robot_in;
using testing::run_until;
using testing::small;
using testing::start_us;

TEST(SimRobotMotion, ARollingShutterSlantsAVerticalEdgeWhileTheHeadTurns) {
  const std::string bar =
      "[joints]\nsettle_time_constant_s = 0\n"
      "[object]\nsize_m = [0.05, 2]\ntexture = { colour = [250, 0, 0] }\n"
      "[wall]\ntexture = { colour = [0, 0, 0] }\n"
      "[[target_test]]\nposition_m = [0.8, 0.0, 0.2]\n";
  const auto slant_px = [&](const std::string& readout) {
    const auto robot = robot_in(small + readout + bar);
    robot->command({start_us, {0.4, 0.0}, 0.1});  // 0.83 rad/s to the left
    run_until(*robot, start_us + 200'000);
    const base::ImageView image = robot->next_frame()->image;
    const auto middle = [&](int y) {
      double sum = 0.0, weight = 0.0;
      for (int x = 0; x < image.width_px; ++x) {
        sum += x * image.row(y)[3 * x];
        weight += image.row(y)[3 * x];
      }
      return sum / weight;
    };
    return middle(100) - middle(20);
  };
  // 80 of 119 rows of 30 ms at 0.83 rad/s move the bar by 16.7 mrad; at 152 px a radian, and the
  // camera in front of the neck, nearly 3 px to the right.
  constexpr double expected_px = 80.0 / 119.0 * 0.03 * 0.826797 * 152.0;
  const double skew = slant_px("readout_s = 0.03\n") - slant_px("");
  EXPECT_NEAR(skew, expected_px, 0.15 * expected_px);
}

TEST(SimRobotMotion, AnObjectMovesBetweenTwoLooks) {
  const std::string moving = "velocity_m_s = [0, 0.2, 0.1]\nmoving_s = [0.1, 0.2]\n";
  const auto robot = robot_in(small + "[object]\ntexture = { colour = [250, 0, 0] }\n" + one_test +
                              "range_m = 0.4\n" + moving);
  const SimTruth before = robot->truth();
  const geometry::Frame first = *robot->next_frame();
  const std::int64_t first_us = first.utime_us;
  const geometry::Pixel first_pixel = red_centre(first.image);
  run_until(*robot, start_us + 300'000);
  const geometry::Frame last = *robot->next_frame();
  const std::int64_t last_us = last.utime_us;
  const geometry::Pixel last_pixel = red_centre(last.image);
  const SimTruth after = robot->truth();
  const Eigen::Vector3d way_m = *after.target_in_torso - *before.target_in_torso;
  EXPECT_LT((way_m - Eigen::Vector3d(0.0, 0.02, 0.01)).norm(), 1e-12);
  constexpr double tolerance_px = 0.3;  // the square's centre of gravity is not its centre's image
  const geometry::Pose pose = geometry::cam_from_torso(after.head, geometry::HeadAngles{});
  EXPECT_LT((first_pixel - *geometry::project(after.camera, pose * *before.target_in_torso)).norm(),
            tolerance_px);
  EXPECT_LT((last_pixel - *geometry::project(after.camera, pose * *after.target_in_torso)).norm(),
            tolerance_px);
  // What was true of a frame stays true of it.
  const geometry::Pixel left_edge = first_pixel + geometry::Pixel(10.0, 0.0);
  EXPECT_TRUE(robot->true_hit_in_frame(first_us, left_edge)->target);
  EXPECT_FALSE(robot->true_hit_in_frame(last_us, left_edge)->target);
  EXPECT_FALSE(robot->true_hit(geometry::HeadAngles{}, left_edge)->target);
  EXPECT_FALSE(robot->true_hit_in_frame(first_us + 1, left_edge));
  // The next time it starts anew.
  robot->next_test();
  EXPECT_EQ(robot->truth().target_in_torso, before.target_in_torso);
  EXPECT_LT((red_centre(robot->next_frame()->image) - first_pixel).norm(), tolerance_px);
}

TEST(SimRobotMotion, AnotherHeadTurnsTheCamera) {
  const auto robot = robot_in(small + "[object]\ntexture = { colour = [250, 0, 0] }\n" + one_test);
  constexpr std::int64_t now_us = start_us + 3'000'000;
  geometry::HeadState state;
  for (std::int64_t t = start_us; t <= now_us; t += 12'000) {
    state.utime_us = t;
    state.measured = {0.1, 0.05};
    robot->observe(state);
    while (*robot->next_frame_utime_us() <= t) {
      const geometry::Frame frame = *robot->next_frame();
      ASSERT_GT(frame.utime_us, t - 100'000);
    }
  }
  const geometry::Frame frame = *robot->next_frame();
  EXPECT_EQ(robot->truth().angles, state.measured);
  const SimTruth truth = robot->truth();
  const geometry::Pixel expected = *geometry::project(
      truth.camera, geometry::cam_from_torso(truth.head, state.measured) * *truth.target_in_torso);
  constexpr double tolerance_px = 0.3;  // a slanted square's centre of gravity
  EXPECT_LT((red_centre(frame.image) - expected).norm(), tolerance_px);
  EXPECT_EQ(robot->frames_dropped(), 0);
  // The scene goes on, the head is not ours to move.
  robot->next_test();
  EXPECT_EQ(robot->truth().angles, state.measured);
  // A loop that was held up gets new frames, not old ones.
  state.utime_us += 10'000'000;
  robot->observe(state);
  EXPECT_GT(robot->next_frame()->utime_us, state.utime_us - 100'000);
  EXPECT_GT(robot->frames_dropped(), 200);
}

}  // namespace
}  // namespace gazed::sim::sim_robot_motion_test
