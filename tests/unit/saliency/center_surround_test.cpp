#include "agent/saliency/center_surround.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "agent/saliency/fixed.hpp"

#include "tests/unit/saliency/reference.hpp"

namespace gazed {
namespace {

struct OwnedPlane {
  std::vector<std::int16_t> samples;
  Plane plane;
};

OwnedPlane random_plane(int width, int height, std::uint64_t seed) {
  OwnedPlane out;
  out.samples.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::mt19937_64 random(seed);
  for (std::int16_t& sample : out.samples)
    sample = static_cast<std::int16_t>(static_cast<int>(random() % 32767) - largest_sample);
  out.plane = {out.samples.data(), width, height};
  return out;
}

cv::Mat as_double(const Plane& plane) {
  cv::Mat out;
  cv::Mat(plane.height, plane.width, CV_16S, plane.data).convertTo(out, CV_64F);
  return out;
}

// Two roundings by half a unit, one of them weighted by less than 1.
constexpr double interpolation_tolerance = 1.01;

TEST(CentreSurround, SurroundIsInterpolatedBilinearlyAndClampedAtTheLastSample) {
  for (int ratio_log2 : {3, 4}) {
    for (const cv::Size size : {cv::Size(40, 30), {41, 31}, {160, 120}, {10, 8}, {1, 1}}) {
      int width = size.width, height = size.height;
      for (int k = 0; k < ratio_log2; ++k) {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
      }
      const OwnedPlane centre = random_plane(size.width, size.height, 1);
      const OwnedPlane surround = random_plane(width, height, 2);
      const cv::Mat expected = reference::interpolated(as_double(surround.plane), ratio_log2, size);
      std::vector<std::int16_t> scratch(static_cast<std::size_t>(width) + 1);
      std::vector<std::int16_t> row(static_cast<std::size_t>(size.width));
      for (int y = 0; y < size.height; ++y) {
        for (CentreSurround mode : {CentreSurround::difference, CentreSurround::sum}) {
          center_surround_row(mode, centre.plane, surround.plane, ratio_log2, y, scratch,
                              row.data());
          const double sign = mode == CentreSurround::sum ? 1.0 : -1.0;
          for (int x = 0; x < size.width; ++x)
            ASSERT_NEAR(row[static_cast<std::size_t>(x)],
                        std::abs(centre.plane.row(y)[x] + sign * expected.at<double>(y, x)),
                        interpolation_tolerance);
        }
      }
    }
  }
}

TEST(CentreSurround, FullScaleAgainstItsOppositeStaysInRange) {
  const std::int16_t full = largest_sample, empty = -largest_sample;
  std::vector<std::int16_t> scratch(2), row(1);
  const ConstPlane bright{&full, 1, 1}, dark{&empty, 1, 1};
  center_surround_row(CentreSurround::difference, bright, dark, 3, 0, scratch, row.data());
  EXPECT_EQ(row[0], largest_map_sample);
  center_surround_row(CentreSurround::sum, dark, dark, 3, 0, scratch, row.data());
  EXPECT_EQ(row[0], largest_map_sample);
  center_surround_row(CentreSurround::sum, bright, dark, 3, 0, scratch, row.data());
  EXPECT_EQ(row[0], 0);
}

// 40 samples: ramp over 2, factors 1/3 and 2/3, both axes.
TEST(BorderRamp, AttenuatesTheOuterTwentiethOnBothAxes) {
  const BorderRamp ramp(40, 30);
  std::vector<std::int16_t> inner(40, 900), corner(40, 900);
  ramp.apply(15, inner.data());
  EXPECT_NEAR(inner[0], 300, 1);
  EXPECT_NEAR(inner[1], 600, 1);
  EXPECT_EQ(inner[2], 900);
  EXPECT_EQ(inner[37], 900);
  EXPECT_NEAR(inner[39], 300, 1);
  ramp.apply(29, corner.data());
  EXPECT_NEAR(corner[0], 100, 1);
  EXPECT_NEAR(corner[20], 300, 1);
}

TEST(BorderRamp, MapsSmallerThan20SamplesHaveNone) {
  const BorderRamp ramp(10, 8);
  std::vector<std::int16_t> row(10, 900);
  ramp.apply(0, row.data());
  EXPECT_EQ(row, std::vector<std::int16_t>(10, 900));
}

}  // namespace
}  // namespace gazed
