#include "drivers/sim/sim_robot.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "robots.hpp"

namespace gazed::sim::sim_robot_test {
namespace {

using namespace robots;

/// Centre of what is red.
geometry::Pixel red_centre(const base::ImageView& image) {
  double weight = 0.0;
  geometry::Pixel sum = geometry::Pixel::Zero();
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const std::uint8_t* p = image.row(y) + 3 * x;
      const double red = std::max(0, p[0] - (p[1] + p[2]) / 2 - 20);
      weight += red;
      sum += red * geometry::Pixel(x, y);
    }
  return sum / weight;
}

TEST(SimRobot, StatesEveryTwelveMillisecondsAndFramesAtTheirRate) {
  const auto robot = robot_in(small);
  SimCamera camera(robot);
  SimHead head(robot);
  EXPECT_EQ(camera.descriptor(), -1);
  EXPECT_EQ(head.descriptor(), -1);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(camera.next_utime_us(), start_us + std::llround(i * 1e6 / 30.0));
    EXPECT_EQ(camera.next_frame()->utime_us, start_us + std::llround(i * 1e6 / 30.0));
    EXPECT_EQ(head.next_utime_us(), start_us + i * 12'000);
    EXPECT_EQ(head.next_state()->utime_us, start_us + i * 12'000);
  }
  EXPECT_TRUE(camera.health().words.empty());
  EXPECT_FALSE(camera.finished());
}

TEST(SimRobot, TheSameSeedGivesTheSameBytes) {
  const std::string scene(default_scene_toml());
  const auto a = robot_in(scene), b = robot_in(scene), other = robot_in(scene, 2);
  std::vector<std::uint8_t> last;
  for (const auto& robot : {a, b, other}) {
    robot->command({start_us, {0.2, 0.1}, 0.3});
    run_until(*robot, start_us + 300'000);
  }
  const geometry::HeadState state_a = *a->next_state(), state_b = *b->next_state();
  EXPECT_EQ(state_a.measured, state_b.measured);
  EXPECT_EQ(state_a.velocity_rad_s, state_b.velocity_rad_s);
  const auto bytes_a = bytes(*a->next_frame());
  EXPECT_EQ(bytes_a, bytes(*b->next_frame()));
  EXPECT_NE(bytes_a, bytes(*other->next_frame()));
}

TEST(SimRobot, PixelNoiseDoesNotChangeTheJoints) {
  const std::string joints = "[joints]\nsettling_error_rad = 0.02\nencoder_noise_rad = 0.001\n";
  const auto quiet = robot_in(small + joints + one_test);
  const auto noisy = robot_in(small + "pixel_noise = 5\ndrop_rate = 0.3\n" + joints + one_test);
  for (const auto& robot : {quiet, noisy}) {
    robot->command({start_us, {0.1, 0.1}, 0.3});
    run_until(*robot, start_us + 500'000);
  }
  EXPECT_EQ(quiet->next_state()->measured, noisy->next_state()->measured);
}

TEST(SimRobot, TheDefaultScenePlaysTheReportsTestsForEver) {
  const auto robot = robot_in(std::string(default_scene_toml()));
  for (int round = 0; round < 4; ++round) {
    const SimTruth truth = robot->truth();
    EXPECT_EQ(truth.test, static_cast<std::size_t>(round % 2));
    const geometry::Frame frame = *robot->next_frame();
    const geometry::HeadAngles angles = *robot->true_angles(frame.utime_us);
    EXPECT_EQ(angles, geometry::HeadAngles{});
    const geometry::Pixel expected = *geometry::project(
        truth.camera, geometry::cam_from_torso(truth.head, angles) * *truth.target_in_torso);
    constexpr double tolerance_px = 0.5;  // noise and the ring move the centre of redness
    EXPECT_LT((red_centre(frame.image) - expected).norm(), tolerance_px);
    const Hit hit = *robot->true_hit(angles, expected);
    EXPECT_TRUE(hit.target);
    EXPECT_NEAR(hit.range_m,
                0.30 * geometry::normalise(truth.camera, expected)->homogeneous().norm(), 1e-9);
    EXPECT_EQ(robot->true_range_m(angles, expected), hit.range_m);
    EXPECT_FALSE(robot->finished());
    robot->next_test();
  }
}

TEST(SimRobot, NextTestPutsTheHeadBackAndLetsTimePass) {
  const auto robot = robot_in(std::string(default_scene_toml()));
  robot->command({start_us, {0.3, -0.1}, 0.5});
  run_until(*robot, start_us + 700'000);
  const geometry::HeadAngles turned = robot->truth().angles;
  EXPECT_NEAR(turned.yaw_rad, 0.3, 0.021);
  EXPECT_NEAR(turned.pitch_rad, -0.1, 0.021);
  const std::int64_t before_us = robot->now_us();
  robot->next_test();
  EXPECT_EQ(robot->now_us(), before_us + SimRobot::pause_us);
  EXPECT_EQ(robot->truth().angles, geometry::HeadAngles{});
  const geometry::HeadState state = *robot->next_state();
  EXPECT_GE(state.utime_us, robot->now_us());
  EXPECT_LT(std::abs(state.measured.yaw_rad), 0.004);
  EXPECT_LT(std::abs(state.velocity_rad_s.yaw_rad), 0.05);
  EXPECT_GE(robot->next_frame()->utime_us, robot->now_us());
  // The truth of a past test can still be asked for.
  const geometry::Pixel centre(319.5, 239.5);
  EXPECT_TRUE(robot->true_hit(geometry::HeadAngles{}, centre, 0)->target);
  EXPECT_FALSE(robot->true_hit(geometry::HeadAngles{}, centre)->target);
}

TEST(SimRobot, ASceneThatDoesNotRepeatEnds) {
  const auto robot = robot_in("repeat = false\n" + small + one_test + one_test);
  SimCamera camera(robot);
  SimHead head(robot);
  robot->next_test();
  EXPECT_FALSE(camera.finished());
  EXPECT_TRUE(camera.next_frame());
  robot->next_test();
  EXPECT_TRUE(camera.finished());
  EXPECT_TRUE(head.finished());
  EXPECT_FALSE(camera.next_utime_us());
  EXPECT_FALSE(camera.next_frame());
  EXPECT_FALSE(head.next_utime_us());
  EXPECT_FALSE(head.next_state());
  robot->next_test();
  EXPECT_TRUE(camera.finished());
}

TEST(SimRobot, AnObjectMovesBetweenTwoLooks) {
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

TEST(SimRobot, AnotherHeadTurnsTheCamera) {
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

TEST(SimRobot, ARollingShutterIsJudgedAtEachPixelsOwnRow) {
  const std::string creeping = "[joints]\nsettle_time_constant_s = 0.08\n";
  const auto robot = robot_in(small + "readout_s = 0.037\ndelay_s = 0.002\n" + creeping +
                              "[object]\nsize_m = [0.01, 0.01]\n" + one_test);
  robot->command({start_us, {0.1, 0.0}, 0.3});
  run_until(*robot, start_us + 190'000);
  const std::int64_t exposed_us = *robot->next_frame_utime_us() - 37'000;
  const std::int64_t stamp_us = robot->next_frame()->utime_us;
  EXPECT_EQ(stamp_us, exposed_us - 2'000);
  const double first_rad = robot->true_angles(stamp_us)->yaw_rad;
  const double middle_rad = robot->true_angles(stamp_us, 59.5)->yaw_rad;
  const double last_rad = robot->true_angles(stamp_us, 119.0)->yaw_rad;
  EXPECT_GT(last_rad - first_rad, 0.005);
  // First-order creep: what is left of the way falls by the same share in the same time.
  EXPECT_NEAR((0.1 - middle_rad) / (0.1 - first_rad), (0.1 - last_rad) / (0.1 - middle_rad), 0.02);
  // The object's left edge as the picture's middle row shows it, which is not where the first and
  // the last row's angles would show it.
  const SimTruth truth = robot->truth();
  const auto seen_at = [&](double yaw_rad) {
    const geometry::Pose pose = geometry::cam_from_torso(truth.head, {yaw_rad, 0.0});
    return *geometry::project(truth.camera, pose * *truth.target_in_torso);
  };
  const geometry::Pixel seen = seen_at(middle_rad);
  ASSERT_GT((seen - seen_at(first_rad)).norm(), 0.5);
  const double half_px = 0.5 * 0.01 / 0.3 * truth.camera.focal_px.x();
  for (const double side : {-1.0, 1.0}) {
    const geometry::Pixel inside = seen + geometry::Pixel(side * (half_px - 0.3), 0.0);
    const geometry::Pixel outside = seen + geometry::Pixel(side * (half_px + 0.3), 0.0);
    EXPECT_TRUE(robot->true_hit_in_frame(stamp_us, inside)->target);
    EXPECT_FALSE(robot->true_hit_in_frame(stamp_us, outside)->target);
  }
}

TEST(SimRobot, AutomaticExposureStepsWhenTheHeadHasTurned) {
  const auto robot =
      robot_in(small + "exposure_step = 0.3\n" + "[room]\nbackground = [100, 100, 100]\n");
  const auto grey = [&] { return static_cast<int>(robot->next_frame()->image.row(60)[3 * 80]); };
  const int before = grey();
  EXPECT_EQ(before, 100);
  std::vector<int> levels;
  for (int look = 0; look < 8; ++look) {
    const std::int64_t now_us = robot->now_us();
    robot->command({now_us, {look % 2 == 0 ? 0.1 : 0.0, 0.0}, 0.3});
    run_until(*robot, now_us + 600'000);
    levels.push_back(grey());
    EXPECT_EQ(grey(), levels.back());  // and stays while the head does
  }
  const auto [darkest, brightest] = std::minmax_element(levels.begin(), levels.end());
  EXPECT_GE(*darkest, 70);
  EXPECT_LE(*brightest, 130);
  EXPECT_GT(*brightest - *darkest, 15);
}

TEST(SimRobot, WhatCannotBeBuiltIsRefusedAtOnce) {
  EXPECT_THROW(robot_in("[robot]\ndistortion = [-3, 0, 0, 0, 0]\n"), std::invalid_argument);
  EXPECT_THROW(robot_in(one_test + "[[report_test]]\nnumber = 2\nobject = { size_m = [9, 9] }\n"),
               std::invalid_argument);
}

}  // namespace
}  // namespace gazed::sim::sim_robot_test
