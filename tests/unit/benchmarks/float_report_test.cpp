#include "tests/benchmarks/float_report.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/benchmarks/room_frame.hpp"
#include "tests/unit/agent/saliency/comparison.hpp"
#include "tests/unit/agent/saliency/reference.hpp"

namespace gazed::benchmarks::float_report_test {
namespace {

// A peer that computed something else would be no peer.
TEST(FloatReport, IsTheReportModel) {
  const base::Image room = room_frame(640, 480);
  cv::Mat rgb(480, 640, CV_8UC3);
  std::copy_n(room.view().data, rgb.total() * rgb.elemSize(), rgb.data);
  saliency::SaliencySettings settings;
  settings.profile = saliency::SaliencyProfile::report;
  const saliency::reference::Result expected = saliency::reference::look_rgb(rgb, settings);

  cv::Mat map;
  float_report(rgb).convertTo(map, CV_64F);
  // cv::resize interpolates half a sample beside where the report profile looks.
  constexpr double of_another_interpolation = 0.95;
  EXPECT_GE(saliency::correlation(map, expected.map), of_another_interpolation);
  cv::Point winner;
  cv::minMaxLoc(map, nullptr, nullptr, nullptr, &winner);
  EXPECT_LE(std::abs(winner.x - expected.winner.x), 1);
  EXPECT_LE(std::abs(winner.y - expected.winner.y), 1);
}

}  // namespace
}  // namespace gazed::benchmarks::float_report_test
