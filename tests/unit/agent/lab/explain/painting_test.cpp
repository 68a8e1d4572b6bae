#include "agent/lab/explain/painting.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "agent/geometry/robot.hpp"

namespace gazed::lab::explain::painting_test {
namespace {

constexpr std::int64_t utime_us = 1'700'000'000'000'000;

/// One look at a grey frame: a target, its outline, a corner that was used and one that was not.
ReplayedFixation one_look() {
  ReplayedFixation out;
  cycle::Fixation& fixation = out.fixation;
  fixation.robot =
      triangulation::all_looks::believed_before(geometry::robot_profile("nao-v6")->rig);
  fixation.look_count = 1;
  cycle::FixationLook& look = fixation.looks[0];
  look.utime_us = utime_us;
  look.pixel = {300.0, 200.0};
  look.corners[0] = {{100.0F, 50.0F}, true};
  look.corners[1] = {{500.0F, 400.0F}, false};
  look.corner_count = 2;
  fixation.patch_half_size_px = 30.0;
  fixation.outline.points_px[0] = {290.0F, 190.0F};
  fixation.outline.points_px[1] = {310.0F, 190.0F};
  fixation.outline.points_px[2] = {300.0F, 215.0F};
  fixation.outline.count = 3;
  saliency::SaliencyResult seen;
  seen.peak_px = {400.0, 300.0};
  seen.saliency = 0.5F;
  out.frames.emplace_back(utime_us, cv::Mat(480, 640, CV_8UC3, cv::Scalar(120, 120, 120)), seen);
  return out;
}

/// Whether a frame's pixel, enlarged twice, or one next to it, has that colour: lines are smoothed.
bool is_painted(const cv::Mat& picture, double x_px, double y_px, const Ink& ink) {
  constexpr double likeness = 60.0;  // of three channels
  const auto x = static_cast<int>(2 * x_px), y = static_cast<int>(2 * y_px);
  for (int row = y - 1; row <= y + 2; ++row) {
    for (int column = x - 1; column <= x + 2; ++column) {
      const auto& bgr = picture.at<cv::Vec3b>(row, column);
      if (cv::norm(cv::Scalar(bgr[0], bgr[1], bgr[2]) - ink.bgr) < likeness) return true;
    }
  }
  return false;
}

TEST(ExplainPainting, EverythingIsWhereItWasFound) {
  const cv::Mat picture = painted_look(one_look(), 0, {});
  ASSERT_EQ(picture.size(), cv::Size(1280, 960));
  EXPECT_TRUE(is_painted(picture, 100.0, 50.0, ink::used));
  EXPECT_TRUE(is_painted(picture, 500.0, 400.0, ink::rejected));
  EXPECT_TRUE(is_painted(picture, 305.0, 200.0, ink::target));
  EXPECT_TRUE(is_painted(picture, 300.0, 190.0, ink::outline));
  EXPECT_TRUE(is_painted(picture, 270.0, 200.0, ink::patch));
  EXPECT_TRUE(is_painted(picture, 411.0, 300.0, ink::winner));
  EXPECT_FALSE(is_painted(picture, 50.0, 400.0, ink::used));
}

TEST(ExplainPainting, ALookWithoutAFrameHasNoPicture) {
  ReplayedFixation replayed = one_look();
  replayed.frames.clear();
  EXPECT_TRUE(painted_look(replayed, 0, {}).empty());
  EXPECT_TRUE(painted_look(one_look(), 5, {}).empty());
}

TEST(ExplainPainting, APatchIsShownForEachLookThatFoundIt) {
  ReplayedFixation replayed = one_look();
  const int width = painted_patches(replayed).cols;
  EXPECT_GT(width, 0);
  replayed.fixation.look_count = 2;
  replayed.fixation.looks[1] = replayed.fixation.looks[0];
  EXPECT_EQ(painted_patches(replayed).cols, 2 * width);
  replayed.fixation.looks[1].pixel = cycle::no_pixel();
  EXPECT_EQ(painted_patches(replayed).cols, width);
  replayed.fixation.patch_half_size_px = triangulation::not_a_number;
  EXPECT_TRUE(painted_patches(replayed).empty());
}

// A line that a wrong robot puts beyond OpenCV's integers.
TEST(ExplainPainting, WhatIsFarOutsideSpoilsNothing) {
  ReplayedFixation replayed = one_look();
  replayed.fixation.look_count = 2;
  replayed.fixation.looks[0].measured = {0.0, 0.0};
  replayed.fixation.looks[1].measured = {1e-9, 0.0};
  replayed.fixation.looks[1].pixel = {1e12, -1e12};
  EXPECT_FALSE(painted_look(replayed, 0, {}).empty());
}

}  // namespace
}  // namespace gazed::lab::explain::painting_test
