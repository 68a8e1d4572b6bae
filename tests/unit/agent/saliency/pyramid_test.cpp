#include "agent/saliency/pyramid.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace gazed::saliency::pyramid_test {
namespace {

TEST(Reflect101, AgreesWithOpenCv) {
  for (int length = 1; length <= 6; ++length)
    for (int index = -5; index <= length + 5; ++index)
      EXPECT_EQ(reflect_101(index, length),
                cv::borderInterpolate(index, length, cv::BORDER_REFLECT_101))
          << index << " of " << length;
}

cv::Mat random_plane(int width, int height, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  cv::Mat plane(height, width, CV_16S);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      plane.at<std::int16_t>(y, x) =
          static_cast<std::int16_t>(static_cast<int>(random() % 32767) - largest_sample);
  return plane;
}

cv::Mat pyr_down(const cv::Mat& plane) {
  cv::Mat wide, half;
  plane.convertTo(wide, CV_64F);
  cv::pyrDown(wide, half);
  return half;
}

void copy_row(const cv::Mat& plane, int y, std::int16_t* to) {
  std::copy_n(plane.ptr<std::int16_t>(y), plane.cols, to);
}

// Streamed through a ring, any size, down to a single sample.
TEST(RowRing, DecimatesAsPyrDown) {
  for (int height : {1, 2, 3, 4, 5, 6, 7, 30, 61}) {
    for (int width : {1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 17, 40, 81}) {
      const cv::Mat plane = random_plane(width, height, 1);
      const cv::Mat expected = pyr_down(plane);
      RowRing<std::int32_t> ring(halved(width), height);
      AlignedSamples<std::int16_t> in(padded_size(width, 1)), row(padded_size(halved(width), 1));
      for (int image = 0; image < 2; ++image) {  // the second with what the first left behind
        int given = 0;
        for (int y = 0; y < height; ++y) {
          copy_row(plane, y, in.data());
          decimate_row(in.data(), width, ring.next_row());
          ring.advance([&](const FiveRows<std::int32_t>& rows) {
            decimate_columns(rows, halved(width), row.data());
            for (int x = 0; x < halved(width); ++x)
              ASSERT_NEAR(row.data()[x], expected.at<double>(given, x), 0.5)
                  << width << 'x' << height << " at " << x << ',' << given;
            ++given;
          });
        }
        EXPECT_EQ(given, halved(height));
      }
    }
  }
}

TEST(Pyramid, LevelsAreThoseOfPyrDown) {
  Pyramid pyramid(163 * 4 - 1, 121 * 4);
  const Plane level2 = pyramid.level(2);
  ASSERT_EQ(level2.width, 163);
  ASSERT_EQ(level2.height, 121);
  cv::Mat expected = random_plane(level2.width, level2.height, 2);
  for (int y = 0; y < level2.height; ++y) copy_row(expected, y, level2.row(y));
  pyramid.build();
  // Half a unit of rounding at each level, of which the filters pass on less than all.
  constexpr double tolerance = 1.0;
  for (int k = 3; k <= last_level; ++k) {
    expected = pyr_down(expected);
    const Plane level = pyramid.level(k);
    ASSERT_EQ(level.width, expected.cols);
    ASSERT_EQ(level.height, expected.rows);
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x)
        ASSERT_NEAR(level.row(y)[x], expected.at<double>(y, x), tolerance) << "level " << k;
  }
}

}  // namespace
}  // namespace gazed::saliency::pyramid_test
