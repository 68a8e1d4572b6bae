#include "tests/benchmarks/metrics.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "agent/saliency/saliency.hpp"

namespace gazed::benchmarks {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<double> values_at(const cv::Mat& map, std::span<const cv::Point> cells) {
  std::vector<double> values;
  values.reserve(cells.size());
  for (const cv::Point& cell : cells) values.push_back(map.at<double>(cell));
  return values;
}

double bilinear(const cv::Mat& map, double x, double y) {
  x = std::clamp(x, 0.0, map.cols - 1.0);
  y = std::clamp(y, 0.0, map.rows - 1.0);
  const int x0 = std::min(static_cast<int>(x), map.cols - 2);
  const int y0 = std::min(static_cast<int>(y), map.rows - 2);
  const double fx = x - x0, fy = y - y0;
  return (1 - fy) * ((1 - fx) * map.at<double>(y0, x0) + fx * map.at<double>(y0, x0 + 1)) +
         fy * ((1 - fx) * map.at<double>(y0 + 1, x0) + fx * map.at<double>(y0 + 1, x0 + 1));
}

}  // namespace

cv::Mat at_scored_size(const cv::Mat& map) {
  constexpr double cell_px = 8.0;
  cv::Mat out(scored_size, CV_64F);
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      const double x_px = cell_px * (x + 0.5) - 0.5, y_px = cell_px * (y + 0.5) - 0.5;
      out.at<double>(y, x) =
          bilinear(map, x_px / saliency::saliency_cell_px, y_px / saliency::saliency_cell_px);
    }
  }
  return out;
}

double area_under_curve(std::vector<double> positives, std::vector<double> negatives) {
  if (positives.empty() || negatives.empty()) return not_a_number;
  std::sort(negatives.begin(), negatives.end());
  std::int64_t twice_won = 0;
  for (const double value : positives) {
    const auto [below, above] = std::equal_range(negatives.begin(), negatives.end(), value);
    twice_won += (below - negatives.begin()) + (above - negatives.begin());
  }
  return static_cast<double>(twice_won) /
         (2.0 * static_cast<double>(positives.size()) * static_cast<double>(negatives.size()));
}

double nss(const cv::Mat& map, std::span<const cv::Point> fixations) {
  if (fixations.empty()) return not_a_number;
  cv::Scalar mean, deviation;
  cv::meanStdDev(map, mean, deviation);
  if (deviation[0] == 0.0) return 0.0;
  double sum = 0.0;
  for (const double value : values_at(map, fixations)) sum += (value - mean[0]) / deviation[0];
  return sum / static_cast<double>(fixations.size());
}

double auc_judd(const cv::Mat& map, std::span<const cv::Point> fixations) {
  cv::Mat fixated = cv::Mat::zeros(map.size(), CV_8U);
  for (const cv::Point& cell : fixations) fixated.at<std::uint8_t>(cell) = 1;
  std::vector<double> positives, negatives;
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x)
      (fixated.at<std::uint8_t>(y, x) != 0 ? positives : negatives).push_back(map.at<double>(y, x));
  return area_under_curve(std::move(positives), std::move(negatives));
}

double shuffled_auc(const cv::Mat& map, std::span<const cv::Point> fixations,
                    std::span<const cv::Point> of_other_pictures) {
  return area_under_curve(values_at(map, fixations), values_at(map, of_other_pictures));
}

}  // namespace gazed::benchmarks
