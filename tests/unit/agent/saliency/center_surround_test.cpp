#include "agent/saliency/center_surround.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "agent/saliency/fixed.hpp"

#include "tests/unit/agent/saliency/reference.hpp"

namespace gazed::saliency::center_surround_test {
namespace {

OwnedPlane<std::int16_t> random_plane(int width, int height, std::uint64_t seed) {
  OwnedPlane<std::int16_t> out(width, height);
  std::mt19937_64 random(seed);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.view().row(y)[x] =
          static_cast<std::int16_t>(static_cast<int>(random() % 32767) - largest_sample);
  return out;
}

OwnedPlane<std::int16_t> one_sample(std::int16_t value) {
  OwnedPlane<std::int16_t> out(1, 1);
  *out.view().data = value;
  return out;
}

cv::Mat as_double(const Plane& plane) {
  cv::Mat out;
  cv::Mat(plane.height, plane.width, CV_16S, plane.data,
          static_cast<std::size_t>(plane.stride) * sizeof(std::int16_t))
      .convertTo(out, CV_64F);
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
      OwnedPlane<std::int16_t> centre = random_plane(size.width, size.height, 1);
      OwnedPlane<std::int16_t> surround = random_plane(width, height, 2);
      const cv::Mat expected =
          reference::interpolated(as_double(surround.view()), ratio_log2, size);
      AlignedSamples<std::int16_t> row(padded_size(size.width, 1));
      CentreSurroundRows rows(160);
      for (CentreSurround mode : {CentreSurround::difference, CentreSurround::sum}) {
        rows.begin(mode, centre.view(), surround.view(), ratio_log2);
        const double sign = mode == CentreSurround::sum ? 1.0 : -1.0;
        for (int y = 0; y < size.height; ++y) {
          rows.next(row.data());
          for (int x = 0; x < size.width; ++x)
            ASSERT_NEAR(row.data()[x],
                        std::abs(centre.view().row(y)[x] + sign * expected.at<double>(y, x)),
                        interpolation_tolerance);
        }
      }
    }
  }
}

TEST(CentreSurround, FullScaleAgainstItsOppositeStaysInRange) {
  OwnedPlane<std::int16_t> bright = one_sample(largest_sample), dark = one_sample(-largest_sample);
  AlignedSamples<std::int16_t> row(lane_count);
  CentreSurroundRows rows(1);
  rows.begin(CentreSurround::difference, bright.view(), dark.view(), 3);
  rows.next(row.data());
  EXPECT_EQ(row.data()[0], largest_map_sample);
  rows.begin(CentreSurround::sum, dark.view(), dark.view(), 3);
  rows.next(row.data());
  EXPECT_EQ(row.data()[0], largest_map_sample);
  rows.begin(CentreSurround::sum, bright.view(), dark.view(), 3);
  rows.next(row.data());
  EXPECT_EQ(row.data()[0], 0);
}

AlignedSamples<std::int16_t> row_of(int samples, std::int16_t value) {
  AlignedSamples<std::int16_t> row(padded_size(samples, 1));
  std::fill_n(row.data(), samples, value);
  return row;
}

// Random levels of a frame of any size: opposite full scales beside each other never wrap.
TEST(CentreSurround, FullScalesBesideEachOtherStayInRange) {
  OwnedPlane<std::int16_t> centre(40, 30), surround(5, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      surround.view().row(y)[x] = (x + y) % 2 == 0 ? largest_sample : -largest_sample;
  fill(centre.view(), static_cast<std::int16_t>(-largest_sample));
  CentreSurroundRows rows(40);
  rows.begin(CentreSurround::difference, centre.view(), surround.view(), 3);
  AlignedSamples<std::int16_t> row(40);
  for (int y = 0; y < 30; ++y) {
    rows.next(row.data());
    for (int x = 0; x < 40; ++x) ASSERT_GE(row.data()[x], 0);
  }
}

// 40 samples: ramp over 2, factors 1/3 and 2/3, both axes.
TEST(BorderRamp, AttenuatesTheOuterTwentiethOnBothAxes) {
  const BorderRamp ramp(40, 30);
  auto inner = row_of(40, 900), corner = row_of(40, 900);
  ramp.apply(15, inner.data());
  EXPECT_NEAR(inner.data()[0], 300, 1);
  EXPECT_NEAR(inner.data()[1], 600, 1);
  EXPECT_EQ(inner.data()[2], 900);
  EXPECT_EQ(inner.data()[37], 900);
  EXPECT_NEAR(inner.data()[39], 300, 1);
  ramp.apply(29, corner.data());
  EXPECT_NEAR(corner.data()[0], 100, 1);
  EXPECT_NEAR(corner.data()[20], 300, 1);
}

// Rows whose ramps meet in one I16x8, and rows of several with ramps of more than one.
TEST(BorderRamp, EveryColumnIsAttenuatedOnce) {
  for (int width : {20, 21, 39, 45, 81, 161, 320, 640}) {
    const BorderRamp ramp(width, width);
    auto row = row_of(width, 20000);
    ramp.apply(width / 2, row.data());
    const int length = width / 20;
    for (int x = 0; x < width; ++x) {
      const int from_border = std::min(x, width - 1 - x);
      const double factor = std::min(1.0, (from_border + 1.0) / (length + 1));
      ASSERT_NEAR(row.data()[x], 20000 * factor, 2.0) << x << " of " << width;
    }
  }
}

TEST(BorderRamp, MapsSmallerThan20SamplesHaveNone) {
  const BorderRamp ramp(10, 8);
  auto row = row_of(10, 900);
  ramp.apply(0, row.data());
  for (int x = 0; x < 10; ++x) EXPECT_EQ(row.data()[x], 900);
}

}  // namespace
}  // namespace gazed::saliency::center_surround_test
