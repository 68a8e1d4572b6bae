// Frame to level 2, against the same in double precision: where 16 bits would wrap, if anywhere.
#include "agent/saliency/low_levels.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "agent/saliency/fixed.hpp"

#include "tests/unit/agent/saliency/comparison.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/reference.hpp"

namespace gazed::saliency::low_levels_test {
namespace {

using frames::Canvas;

// Samples; full scale is 2^14. Report: the reciprocal, rounded down and scaled by 2047/2048, is up
// to a part in 1200 short (14), and 16-bit rounding between the passes adds 8 of Q11 x 8. Robust:
// three passes round at Q4, the opponents once.
constexpr double report_tolerance = 24.0;
constexpr double robust_tolerance = 6.0;

class LevelTwoOf : public testing::TestWithParam<SaliencyProfile> {
 protected:
  void expect_reference(const Canvas& canvas, bool clamp_negative, const std::string& what) {
    const base::ImageView frame = canvas.view();
    SaliencySettings settings;
    settings.profile = GetParam();
    settings.clamp_negative = clamp_negative;
    cv::Mat rgb(frame.height_px, frame.width_px, CV_8UC3);
    std::copy_n(frame.data, std::size_t{3} * rgb.total(), rgb.data);
    const reference::Planes expected = reference::level_two(rgb, settings);

    Pyramid s(rgb.cols, rgb.rows), d(rgb.cols, rgb.rows), e(rgb.cols, rgb.rows);
    const LevelTwo level2{s.level(2), d.level(2), e.level(2)};
    const bool report = GetParam() == SaliencyProfile::report;
    if (report) {
      PixelOpponents(rgb.cols, rgb.rows, clamp_negative).read(frame, level2);
    } else {
      LateOpponents(rgb.cols, rgb.rows).read(frame, level2);
    }
    const double colour_scale = report ? full_scale : 255.0 * samples_per_colour_level;
    const double tolerance = report ? report_tolerance : robust_tolerance;
    expect_plane(level2[0], expected.intensity * double{samples_per_grey_level}, tolerance,
                 what + ", intensity");
    expect_plane(level2[1], expected.red_green * colour_scale, tolerance, what + ", red-green");
    expect_plane(level2[2], expected.blue_yellow * colour_scale, tolerance, what + ", blue-yellow");
  }

 private:
  static void expect_plane(const Plane& plane, const cv::Mat& expected, double tolerance,
                           const std::string& what) {
    ASSERT_EQ(cv::Size(plane.width, plane.height), expected.size());
    double worst = 0.0;
    for (int y = 0; y < plane.height; ++y) {
      for (int x = 0; x < plane.width; ++x) {
        worst = std::max(worst, std::abs(plane.row(y)[x] - expected.at<double>(y, x)));
        ASSERT_LE(std::abs(plane.row(y)[x]), largest_sample) << what;
      }
    }
    EXPECT_LE(worst, tolerance) << what;
  }
};

INSTANTIATE_TEST_SUITE_P(Profiles, LevelTwoOf,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust),
                         profile_name);

const std::vector<std::pair<std::string, frames::Colour>>& pure_colours() {
  static const std::vector<std::pair<std::string, frames::Colour>> all{
      {"red", frames::red},       {"green", frames::green}, {"blue", frames::blue},
      {"yellow", frames::yellow}, {"black", frames::black}, {"white", frames::white}};
  return all;
}

TEST_P(LevelTwoOf, FullFramesOfPureColours) {
  for (const auto& [name, colour] : pure_colours())
    for (bool clamp : {false, true}) expect_reference(Canvas(161, 121, colour), clamp, name);
}

TEST_P(LevelTwoOf, EdgesOfPureColours) {
  for (const auto& [name, colour] : pure_colours()) {
    for (const auto& [other_name, other] : pure_colours()) {
      const Canvas canvas = Canvas(200, 160, colour)
                                .rectangle(97, 0, 103, 160, other)
                                .rectangle(20, 31, 40, 3, other)
                                .rectangle(130, 90, 5, 50, colour);
      for (bool clamp : {false, true})
        expect_reference(canvas, clamp, name + " beside " + other_name);
    }
  }
}

// Hues of the darkest pixels that have one, and stripes of one pixel.
TEST_P(LevelTwoOf, DarkColoursAndStripes) {
  Canvas stripes(200, 160, frames::black);
  for (int x = 0; x < 200; x += 2)
    stripes.rectangle(x, 0, 1, 160, x % 4 == 0 ? frames::red : frames::blue);
  expect_reference(stripes, false, "stripes");
  expect_reference(Canvas(200, 160, {77, 0, 0}).rectangle(100, 0, 100, 160, {0, 0, 77}), false,
                   "dark red beside dark blue");
  expect_reference(Canvas(200, 160, {76, 0, 0}).rectangle(100, 0, 100, 160, {0, 78, 0}), false,
                   "no hue beside dark green");
}

TEST_P(LevelTwoOf, DrawnFrames) {
  for (const frames::NamedFrame& frame : frames::drawn_frames())
    expect_reference(frame.canvas, false, frame.name);
}

}  // namespace
}  // namespace gazed::saliency::low_levels_test
