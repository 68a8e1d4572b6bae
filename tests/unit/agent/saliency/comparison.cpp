#include "tests/unit/agent/saliency/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "tests/unit/agent/saliency/reference.hpp"

namespace gazed::saliency {

cv::Mat as_mat(const SaliencyMap& map) {
  cv::Mat out(map.height, map.width, CV_64F);
  std::transform(map.samples.begin(), map.samples.end(), out.begin<double>(),
                 [](std::uint16_t s) { return s / 256.0; });
  return out;
}

double correlation(const cv::Mat& a, const cv::Mat& b) {
  cv::Scalar mean_a, mean_b, sigma_a, sigma_b;
  cv::meanStdDev(a, mean_a, sigma_a);
  cv::meanStdDev(b, mean_b, sigma_b);
  if (sigma_a[0] == 0.0 && sigma_b[0] == 0.0) return 1.0;
  if (sigma_a[0] == 0.0 || sigma_b[0] == 0.0) return 0.0;
  return cv::Mat(a - mean_a[0]).dot(b - mean_b[0]) /
         (static_cast<double>(a.total()) * sigma_a[0] * sigma_b[0]);
}

Comparison compare(const base::ImageView& rgb, const SaliencySettings& settings) {
  cv::Mat picture(rgb.height_px, rgb.width_px, CV_8UC3);
  for (int y = 0; y < rgb.height_px; ++y)
    std::copy_n(rgb.row(y), 3 * rgb.width_px, picture.ptr<std::uint8_t>(y));
  const reference::Result expected = reference::look_rgb(picture, settings);

  Saliency stage(settings, rgb.width_px, rgb.height_px);
  const SaliencyResult result = stage.examine(rgb);
  const cv::Mat map = as_mat(result.map);
  cv::Point winner;
  cv::minMaxLoc(map, nullptr, nullptr, nullptr, &winner);

  Comparison c;
  c.correlation = correlation(map, expected.map);
  c.winner_distance =
      std::max(std::abs(winner.x - expected.winner.x), std::abs(winner.y - expected.winner.y));
  c.saliency = result.saliency;
  c.reference_saliency = expected.map.at<double>(expected.winner) / 255.0;
  return c;
}

}  // namespace gazed::saliency
