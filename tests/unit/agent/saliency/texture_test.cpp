#include "agent/saliency/texture.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <random>
#include <utility>

#include "agent/saliency/fixed.hpp"

namespace gazed::saliency::texture_test {
namespace {

/// A pyramid whose level 2 has samples below `limit`, and what the header's formula makes of it.
struct Drawn {
  Drawn(int frame_width, int frame_height, int limit, std::uint64_t seed)
      : pyramid(frame_width, frame_height) {
    std::mt19937_64 random(seed);
    const Plane level2 = pyramid.level(2);
    cv::Mat samples(level2.height, level2.width, CV_64F);
    for (int y = 0; y < level2.height; ++y)
      for (int x = 0; x < level2.width; ++x)
        samples.at<double>(y, x) = level2.row(y)[x] =
            static_cast<std::int16_t>(random() % static_cast<std::uint64_t>(limit));
    const cv::Mat cross = (cv::Mat_<double>(3, 3) << 0, -.25, 0, -.25, 1, -.25, 0, -.25, 0);
    cv::Mat changes;
    cv::filter2D(samples, changes, CV_64F, cross, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
    cv::pyrDown(cv::abs(changes), expected);
  }

  Pyramid pyramid;
  cv::Mat expected;
};

// Two quarters are rounded, then the reduced sample: half a unit each.
constexpr double rounding = 1.5;

TEST(Texture, FollowsItsDefinition) {
  constexpr int white = 255 * samples_per_grey_level + 1;
  for (const auto& [width, height] : {std::pair{640, 480}, {162, 120}, {501, 643}}) {
    Drawn drawn(width, height, white, 7);
    Texture texture(width, height);
    for (int round = 0; round < 2; ++round) {  // nothing is kept from the frame before
      const ConstPlane found = texture.of(drawn.pyramid);
      ASSERT_EQ(found.width, drawn.expected.cols);
      ASSERT_EQ(found.height, drawn.expected.rows);
      for (int y = 0; y < found.height; ++y)
        for (int x = 0; x < found.width; ++x)
          ASSERT_NEAR(found.row(y)[x], drawn.expected.at<double>(y, x), rounding) << x << ',' << y;
    }
  }
}

TEST(Texture, OfAnEvenPlaneIsZero) {
  Drawn drawn(640, 480, 1, 1);
  const Plane level2 = drawn.pyramid.level(2);
  fill(level2, std::int16_t{5000});
  Texture texture(640, 480);
  const ConstPlane found = texture.of(drawn.pyramid);
  for (int y = 0; y < found.height; ++y)
    EXPECT_TRUE(std::all_of(found.row(y), found.row(y) + found.width,
                            [](std::int16_t sample) { return sample == 0; }));
}

}  // namespace
}  // namespace gazed::saliency::texture_test
