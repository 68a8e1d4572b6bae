// What the simulated camera gives: when, how bright, and what is lost.
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "robots.hpp"

namespace gazed::sim::sim_camera_test {
namespace {

using namespace robots;

bool nobody(std::int64_t /*utime_us*/) {
  return false;
}

// Of frames that show the same light only the first is rendered.
TEST(SimCamera, ASeriesOfFramesShowsWhatEachOfThemAloneWould) {
  const std::string test_2 = "[[report_test]]\nnumber = 2\n";
  const auto series = robot_in(small + one_test + test_2),
             alone = robot_in(small + one_test + test_2);
  const auto compare_after = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      static_cast<void>(series->next_frame());
      static_cast<void>(alone->next_frame(nobody));
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

TEST(SimCamera, LostFramesAreCounted) {
  const auto robot = robot_in(small + "drop_rate = 0.25\n");
  constexpr int frames = 300;
  std::int64_t last_us = 0;
  for (int i = 0; i < frames; ++i) last_us = robot->next_frame()->utime_us;
  const double periods = static_cast<double>(last_us - start_us) * 30e-6 + 1.0;
  EXPECT_NEAR(periods, frames + robot->frames_dropped(), 0.01);
  EXPECT_NEAR(robot->frames_dropped() / periods, 0.25, 0.08);
}

TEST(SimCamera, FramesComeAfterReadoutWithADelayedStamp) {
  const auto robot = robot_in(small + "readout_s = 0.037\ndelay_s = -0.039\n");
  // The stamp lies 39 ms after the start of exposure; nothing comes before its stamp.
  EXPECT_EQ(robot->next_frame_utime_us(), start_us + 39'000);
  EXPECT_EQ(robot->next_frame()->utime_us, start_us + 39'000);
  const auto prompt = robot_in(small + "readout_s = 0.03\n");
  EXPECT_EQ(prompt->next_frame_utime_us(), start_us + 30'000);
  EXPECT_EQ(prompt->next_frame()->utime_us, start_us);
}

TEST(SimCamera, ARollingShutterSlantsAVerticalEdgeWhileTheHeadTurns) {
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

TEST(SimCamera, ExposureSwingsWithTheTest) {
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

TEST(SimCamera, FramesThatNobodyWantsChangeNoOthers) {
  const std::string scene = small + "pixel_noise = 2.0\nexposure_step = 0.3\n" + one_test;
  const auto watched = robot_in(scene), ignored = robot_in(scene);
  for (int i = 0; i < 40; ++i) {
    if (i == 10)  // another sight: its exposure is drawn anew
      for (const auto& robot : {watched, ignored}) robot->command({start_us, {0.2, 0.1}, 0.3});
    const geometry::Frame all = *watched->next_frame();
    const geometry::Frame some = *ignored->next_frame(nobody);
    EXPECT_EQ(some.utime_us, all.utime_us);
    EXPECT_EQ(some.image.width_px, all.image.width_px);
    EXPECT_EQ(ignored->now_us(), watched->now_us());
  }
  EXPECT_EQ(bytes(*ignored->next_frame()), bytes(*watched->next_frame()));
  EXPECT_EQ(ignored->frames_dropped(), 0);
}

TEST(SimCamera, YuyvFrames) {
  const auto robot = robot_in(small + "format = \"yuyv\"\n" + one_test);
  const geometry::Frame frame = *robot->next_frame();
  EXPECT_EQ(frame.image.format, base::PixelFormat::yuyv);
  EXPECT_EQ(frame.image.row_stride, 320);
  EXPECT_NEAR(frame.image.row(2)[0], 235, 1);  // the white wall
}

}  // namespace
}  // namespace gazed::sim::sim_camera_test
