#include "tests/benchmarks/float_report.hpp"

#include <array>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace gazed::benchmarks {

namespace {

constexpr int map_level = 4, last_level = 8;
constexpr float maximum = 255.0F;
// Noise floors, in the units of the maps: the defaults of SaliencySettings. Full scale of D = R - G
// is 4.5, of E = B - Y 6.
constexpr double intensity_floor = 1.0, red_green_floor = 2.5 / 255.0 * 4.5,
                 blue_yellow_floor = 2.5 / 255.0 * 6.0;

struct Opponents {
  cv::Mat intensity, red_green, blue_yellow;
};

Opponents opponents(const cv::Mat& rgb) {
  cv::Mat pixels;
  rgb.convertTo(pixels, CV_32F);
  std::array<cv::Mat, 3> c;
  cv::split(pixels, c.data());

  Opponents out;
  out.intensity = (c[0] + c[1] + c[2]) / 3.0;
  const cv::Mat dark = out.intensity < 77.0 / 3.0;
  for (cv::Mat& colour : c) {
    cv::divide(colour, out.intensity, colour);
    colour.setTo(0.0, dark);
  }
  cv::Mat difference;
  cv::absdiff(c[0], c[1], difference);
  const cv::Mat red = c[0] - (c[1] + c[2]) / 2, green = c[1] - (c[0] + c[2]) / 2;
  const cv::Mat blue = c[2] - (c[0] + c[1]) / 2;
  const cv::Mat yellow = (c[0] + c[1]) / 2 - difference / 2 - c[2];
  out.red_green = red - green;
  out.blue_yellow = blue - yellow;
  return out;
}

/// N: full scale, times (M - m)^2 / M^2 with m the mean of the other local maxima.
cv::Mat promoted(const cv::Mat& map, double noise_floor) {
  double highest = 0.0;
  cv::Point winner;
  cv::minMaxLoc(map, nullptr, &highest, nullptr, &winner);
  if (highest <= 0.0 || highest < noise_floor) return cv::Mat::zeros(map.size(), CV_32F);

  const cv::Mat cross = cv::getStructuringElement(cv::MORPH_CROSS, {3, 3});
  cv::Mat above, below;
  cv::dilate(map, above, cross);
  cv::erode(map, below, cross);
  cv::Mat peaks = (map >= above) & (map > below) & (map > highest / 10.0);
  peaks.at<std::uint8_t>(winner) = 0;
  const cv::Rect interior(1, 1, map.cols - 2, map.rows - 2);
  const double others = cv::mean(map(interior), peaks(interior))[0];
  const double share = (highest - others) / highest;
  return map * (static_cast<double>(maximum) / highest * share * share);
}

cv::Mat at_map_level(cv::Mat map, int level) {
  for (; level < map_level; ++level) cv::pyrDown(map, map);
  return map;
}

enum class Opponency { difference, sum };

void add_feature_maps(const cv::Mat& plane, Opponency opponency, double noise_floor,
                      cv::Mat& conspicuity) {
  std::vector<cv::Mat> pyramid;
  cv::buildPyramid(plane, pyramid, last_level);
  for (int centre = 2; centre <= map_level; ++centre) {
    const cv::Mat& c = pyramid[static_cast<std::size_t>(centre)];
    for (const int step : {3, 4}) {
      cv::Mat surround, map;
      cv::resize(pyramid[static_cast<std::size_t>(centre + step)], surround, c.size(), 0, 0,
                 cv::INTER_LINEAR);
      if (opponency == Opponency::difference)
        cv::absdiff(c, surround, map);
      else
        map = cv::abs(c + surround);
      const cv::Mat reduced = at_map_level(promoted(map, noise_floor), centre);
      if (conspicuity.empty())
        conspicuity = reduced.clone();
      else
        conspicuity += reduced;
    }
  }
}

}  // namespace

cv::Mat float_report(const cv::Mat& rgb) {
  const Opponents planes = opponents(rgb);
  cv::Mat intensity, colour;
  add_feature_maps(planes.intensity, Opponency::difference, intensity_floor, intensity);
  add_feature_maps(planes.red_green, Opponency::sum, red_green_floor, colour);
  add_feature_maps(planes.blue_yellow, Opponency::sum, blue_yellow_floor, colour);
  return (promoted(intensity, 0.0) + promoted(colour, 0.0)) / 2;
}

}  // namespace gazed::benchmarks
