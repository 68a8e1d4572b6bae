#include "drivers/sim/sim_robot.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>

#include "picture.hpp"

namespace gazed::sim::sim_robot_test {
namespace {

constexpr std::int64_t start_us = 1'700'000'000'000'000;

std::shared_ptr<SimRobot> robot_in(const std::string& scene, std::uint64_t seed = 1) {
  return std::make_shared<SimRobot>(parse_scene(scene, "test.toml"),
                                    *geometry::robot_profile("nao-v6"), seed, start_us);
}

/// A small camera keeps the tests quick.
const std::string small = "[camera]\nwidth_px = 160\nheight_px = 120\n";
const std::string one_test = "[[report_test]]\nnumber = 1\n";

std::vector<std::uint8_t> bytes(const geometry::Frame& frame) {
  const int size = frame.image.row_stride * frame.image.height_px;
  return {frame.image.data, frame.image.data + size};
}

/// Serves events in order up to a time, as the loop does.
void run_until(SimRobot& robot, std::int64_t utime_us) {
  while (true) {
    const auto frame_us = robot.next_frame_utime_us(), state_us = robot.next_state_utime_us();
    if (!frame_us || !state_us || std::min(*frame_us, *state_us) > utime_us) return;
    if (*state_us <= *frame_us)
      (void)robot.next_state();
    else
      (void)robot.next_frame();
  }
}

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
  EXPECT_TRUE(camera.fault().empty());
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

// Of frames that show the same light only the first is rendered.
TEST(SimRobot, ASeriesOfFramesShowsWhatEachOfThemAloneWould) {
  const std::string test_2 = "[[report_test]]\nnumber = 2\n";
  const auto series = robot_in(small + one_test + test_2),
             alone = robot_in(small + one_test + test_2);
  const auto compare_after = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      static_cast<void>(series->next_frame());
      alone->pass_frame();
    }
    EXPECT_EQ(bytes(*series->next_frame()), bytes(*alone->next_frame()));
  };
  compare_after(2);
  for (const auto& robot : {series, alone}) robot->command({start_us, {0.2, 0.1}, 0.3});
  compare_after(1);  // in motion
  compare_after(60);
  for (const auto& robot : {series, alone}) robot->next_test();
  compare_after(0);
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

TEST(SimRobot, LostFramesAreCounted) {
  const auto robot = robot_in(small + "drop_rate = 0.25\n");
  constexpr int frames = 300;
  std::int64_t last_us = 0;
  for (int i = 0; i < frames; ++i) last_us = robot->next_frame()->utime_us;
  const double periods = static_cast<double>(last_us - start_us) * 30e-6 + 1.0;
  EXPECT_NEAR(periods, frames + robot->frames_dropped(), 0.01);
  EXPECT_NEAR(robot->frames_dropped() / periods, 0.25, 0.08);
}

TEST(SimRobot, FramesComeAfterReadoutWithADelayedStamp) {
  const auto robot = robot_in(small + "readout_s = 0.037\ndelay_s = -0.039\n");
  // The stamp lies 39 ms after the start of exposure; nothing comes before its stamp.
  EXPECT_EQ(robot->next_frame_utime_us(), start_us + 39'000);
  EXPECT_EQ(robot->next_frame()->utime_us, start_us + 39'000);
  const auto prompt = robot_in(small + "readout_s = 0.03\n");
  EXPECT_EQ(prompt->next_frame_utime_us(), start_us + 30'000);
  EXPECT_EQ(prompt->next_frame()->utime_us, start_us);
}

TEST(SimRobot, ARollingShutterSlantsAVerticalEdgeWhileTheHeadTurns) {
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

TEST(SimRobot, ExposureSwingsWithTheTest) {
  const auto robot =
      robot_in(small +
               "exposure = 0.5\nexposure_swing = 0.4\n"
               "exposure_period_s = 0.4\nfps = 10\n[room]\nbackground = [100, 100, 100]\n");
  const auto brightness = [&] { return static_cast<int>(robot->next_frame()->image.row(9)[9]); };
  for (int round = 0; round < 2; ++round) {
    for (const int expected : {50, 70, 50, 30, 50}) EXPECT_EQ(brightness(), expected);
    robot->next_test();
  }
}

TEST(SimRobot, FramesThatAreLetGoByCostNothingButTime) {
  const auto watched = robot_in(small + one_test), ignored = robot_in(small + one_test);
  for (int i = 0; i < 3; ++i) {
    (void)watched->next_frame();
    ignored->pass_frame();
    EXPECT_EQ(ignored->now_us(), watched->now_us());
  }
  EXPECT_EQ(bytes(*ignored->next_frame()), bytes(*watched->next_frame()));  // no pixel noise
  EXPECT_EQ(ignored->frames_dropped(), 0);
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

TEST(SimRobot, WhatCannotBeBuiltIsRefusedAtOnce) {
  EXPECT_THROW(robot_in("[robot]\ndistortion = [-3, 0, 0, 0, 0]\n"), std::invalid_argument);
  EXPECT_THROW(robot_in(one_test + "[[report_test]]\nnumber = 2\nobject = { size_m = [9, 9] }\n"),
               std::invalid_argument);
}

TEST(SimRobot, YuyvFrames) {
  const auto robot = robot_in(small + "format = \"yuyv\"\n" + one_test);
  const geometry::Frame frame = *robot->next_frame();
  EXPECT_EQ(frame.image.format, base::PixelFormat::yuyv);
  EXPECT_EQ(frame.image.row_stride, 320);
  EXPECT_NEAR(frame.image.row(2)[0], 235, 1);  // the white wall
}

}  // namespace
}  // namespace gazed::sim::sim_robot_test
