#include "agent/lab/io/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <vector>

namespace gazed::lab::io::overlay_test {
namespace {

constexpr int map_width = 40;
constexpr int map_height = 30;

/// A map of zeros but for three by three samples.
class OverlayOfOnePlace : public ::testing::Test {
 protected:
  cv::Mat overlay(const cv::Mat& photograph, double scale, int column, int row) {
    samples_.assign(map_width * map_height, 0);
    for (int y = std::max(0, row - 1); y <= std::min(map_height - 1, row + 1); ++y) {
      for (int x = std::max(0, column - 1); x <= std::min(map_width - 1, column + 1); ++x) {
        samples_[static_cast<std::size_t>(y * map_width + x)] = 4000;
      }
    }
    const saliency::SaliencyMap map{.samples = samples_, .width = map_width, .height = map_height};
    const geometry::Pixel winner((16.0 * column + 0.5) / scale - 0.5,
                                 (16.0 * row + 0.5) / scale - 0.5);
    return overlay_of(photograph, map, scale,
                      {.winner_px = winner, .saliency = 0.5F, .distinctness = 0.5F});
  }

  std::vector<std::uint16_t> samples_;
};

double brightness(const cv::Mat& picture, int x, int y) {
  const auto pixel = picture.at<cv::Vec3b>(y, x);
  return (pixel[0] + pixel[1] + pixel[2]) / 3.0;
}

TEST_F(OverlayOfOnePlace, LeavesThePhotographAlone) {
  const cv::Mat photograph(480, 640, CV_8UC3, cv::Scalar(90, 90, 90));
  const cv::Mat before = photograph.clone();
  const cv::Mat result = overlay(photograph, 1.0, 10, 10);
  EXPECT_EQ(cv::norm(photograph, before, cv::NORM_INF), 0.0);
  EXPECT_EQ(result.size(), photograph.size());
  EXPECT_EQ(result.type(), CV_8UC3);
}

// The sample (20, 15) lies on pixel (320, 240) of a photograph at scale 1; half a cell off would
// shift the heat's edge, which falls by 150 grey levels in 16 px, by 8 px.
TEST_F(OverlayOfOnePlace, HeatIsCentredOnTheSample) {
  for (const double scale : {1.0, 0.5, 2.0}) {
    const cv::Size size(static_cast<int>(640 / scale), static_cast<int>(480 / scale));
    const cv::Mat result = overlay(cv::Mat(size, CV_8UC3, cv::Scalar(90, 90, 90)), scale, 20, 15);
    const int x = static_cast<int>(std::lround(320.5 / scale - 0.5));
    const int y = static_cast<int>(std::lround(240.5 / scale - 0.5));
    const int inside = static_cast<int>(std::lround(8.0 / scale));  // between cross and ring
    EXPECT_GT(brightness(result, x + inside, y + inside), 130.0) << scale;
    const int edge = static_cast<int>(std::lround(24.0 / scale));  // diagonally beyond the ring
    EXPECT_NEAR(brightness(result, x + edge, y + edge), brightness(result, x - edge, y - edge),
                12.0)
        << scale;
    EXPECT_LT(brightness(result, x / 3, y), 90.0) << scale;
  }
}

// Dark and bright strokes lie side by side, so the mark is seen on black, white and anything else.
TEST_F(OverlayOfOnePlace, RingIsSeenOnAnyBackground) {
  for (const int background : {0, 128, 255}) {
    const cv::Mat result =
        overlay(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(background)), 1.0, 20, 15);
    double darkest = 255.0, brightest = 0.0;
    for (int radius = 16; radius <= 28; ++radius) {  // across the ring, between the cross's arms
      const int diagonal = static_cast<int>(std::lround(radius * std::sqrt(0.5)));
      darkest = std::min(darkest, brightness(result, 320 + diagonal, 240 + diagonal));
      brightest = std::max(brightest, brightness(result, 320 + diagonal, 240 + diagonal));
    }
    EXPECT_LT(darkest, 40.0) << background;
    EXPECT_GT(brightest, 215.0) << background;
  }
}

TEST_F(OverlayOfOnePlace, CaptionKeepsAwayFromTheWinner) {
  const cv::Mat photograph(480, 640, CV_8UC3, cv::Scalar(200, 200, 200));
  const cv::Mat low = overlay(photograph, 1.0, 20, 29);
  EXPECT_LT(brightness(low, 635, 5), 60.0);
  EXPECT_GT(brightness(low, 635, 475), 100.0);
  const cv::Mat high = overlay(photograph, 1.0, 20, 0);
  EXPECT_LT(brightness(high, 635, 475), 60.0);
}

TEST_F(OverlayOfOnePlace, SmallPictureAndWinnerAtTheEdge) {
  const cv::Mat result = overlay(cv::Mat(120, 160, CV_8UC3, cv::Scalar(90, 90, 90)), 4.0, 39, 0);
  EXPECT_EQ(result.size(), cv::Size(160, 120));
}

TEST_F(OverlayOfOnePlace, MapOfZerosHasNoHeat) {
  samples_.assign(map_width * map_height, 0);
  const saliency::SaliencyMap map{.samples = samples_, .width = map_width, .height = map_height};
  const cv::Mat result = overlay_of(cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 90, 90)), map, 1.0,
                                    {.winner_px = {100.0, 100.0}});
  EXPECT_LT(brightness(result, 500, 100), 90.0);
}

}  // namespace
}  // namespace gazed::lab::io::overlay_test
