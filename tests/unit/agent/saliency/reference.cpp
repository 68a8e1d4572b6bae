#include "tests/unit/agent/saliency/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace gazed::saliency::reference {

namespace {

constexpr double kMaximum = 255.0;

cv::Mat pyr_down(const cv::Mat& image) {
  cv::Mat half;
  cv::pyrDown(image, half);
  return half;
}

std::array<cv::Mat, 9> pyramid_from_level_two(const cv::Mat& level2) {
  std::array<cv::Mat, 9> levels;
  levels[2] = level2;
  for (std::size_t k = 3; k < levels.size(); ++k) levels[k] = pyr_down(levels[k - 1]);
  return levels;
}

void attenuate_border(cv::Mat& map) {
  const int length = std::min(std::max(map.cols, map.rows) / 20, std::min(map.cols, map.rows) / 2);
  for (int i = 0; i < length; ++i) {
    const double factor = (i + 1.0) / (length + 1.0);
    map.row(i) *= factor;
    map.row(map.rows - 1 - i) *= factor;
    map.col(i) *= factor;
    map.col(map.cols - 1 - i) *= factor;
  }
}

cv::Mat reduced(cv::Mat map, int level) {
  for (; level < 4; ++level) map = pyr_down(map);
  return map;
}

cv::Mat conspicuity(const cv::Mat& level2, bool sum, bool robust, double noise_floor) {
  const auto levels = pyramid_from_level_two(level2);
  cv::Mat total = cv::Mat::zeros(levels[4].size(), CV_64F);
  for (int c = 2; c <= 4; ++c) {
    for (int ratio : {3, 4}) {
      const cv::Mat& centre = levels[static_cast<std::size_t>(c)];
      const cv::Mat surround =
          interpolated(levels[static_cast<std::size_t>(c + ratio)], ratio, centre.size());
      cv::Mat map = cv::abs(sum ? cv::Mat(centre + surround) : cv::Mat(centre - surround));
      if (robust) {
        attenuate_border(map);
        map = reduced(map, c);
        total += map * promotion(map, noise_floor);
      } else {
        total += reduced(map * promotion(map, noise_floor), c);
      }
    }
  }
  return total;
}

/// Of S, where the intensity at the map's level, or beside it, is that of saturated pixels.
cv::Mat overexposure(const cv::Mat& intensity_at_level_two, double weight) {
  cv::Mat saturated = pyr_down(pyr_down(intensity_at_level_two)) >= 250.0;
  cv::dilate(saturated, saturated, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat weights(saturated.size(), CV_64F, 1.0);
  weights.setTo(weight, saturated);
  return weights;
}

Result combine(const Planes& planes, const SaliencySettings& settings) {
  const bool robust = settings.profile == SaliencyProfile::robust;
  const cv::Mat intensity =
      conspicuity(planes.intensity, false, robust, settings.intensity_noise_floor);
  const cv::Mat colour =
      settings.red_green_weight *
          conspicuity(planes.red_green, !robust, robust, settings.colour_noise_floor / 255.0) +
      settings.blue_yellow_weight *
          conspicuity(planes.blue_yellow, !robust, robust, settings.colour_noise_floor / 255.0);
  const double total = settings.intensity_weight + settings.colour_weight;
  Result result;
  result.map = intensity * (promotion(intensity, 0.0) * settings.intensity_weight / total) +
               colour * (promotion(colour, 0.0) * settings.colour_weight / total);
  if (robust)
    result.map = result.map.mul(overexposure(planes.intensity, settings.overexposed_weight));
  cv::minMaxLoc(result.map, nullptr, nullptr, nullptr, &result.winner);
  return result;
}

cv::Vec3d pixel_opponents(const cv::Vec3b& pixel, bool clamp) {
  const double r = pixel[0], g = pixel[1], b = pixel[2];
  const double intensity = (r + g + b) / 3.0;
  if (r + g + b < 77.0) return {intensity, 0.0, 0.0};
  const double rn = r / intensity, gn = g / intensity, bn = b / intensity;
  double red = rn - (gn + bn) / 2.0;
  double green = gn - (rn + bn) / 2.0;
  double blue = bn - (rn + gn) / 2.0;
  double yellow = (rn + gn) / 2.0 - std::abs(rn - gn) / 2.0 - bn;
  if (clamp) {
    for (double* colour : {&red, &green, &blue, &yellow}) *colour = std::max(*colour, 0.0);
  }
  // Full scale: pure red gives R - G = 4.5 (3 when clamped), pure blue B - Y = 6 (3).
  return {intensity, (red - green) / (clamp ? 3.0 : 4.5), (blue - yellow) / (clamp ? 3.0 : 6.0)};
}

Planes late_opponents(const cv::Mat& r, const cv::Mat& g, const cv::Mat& b) {
  Planes planes;
  planes.intensity = (r + g + b) / 3.0;
  planes.red_green = (r - g) / 255.0;
  planes.blue_yellow = (2.0 * b - (r + g) + cv::abs(r - g) / 2.0) / 510.0;
  return planes;
}

}  // namespace

cv::Mat interpolated(const cv::Mat& surround, int ratio_log2, cv::Size centre) {
  cv::Mat out(centre, CV_64F);
  for (int y = 0; y < centre.height; ++y) {
    for (int x = 0; x < centre.width; ++x) {
      const double px = std::min(std::ldexp(x, -ratio_log2), surround.cols - 1.0);
      const double py = std::min(std::ldexp(y, -ratio_log2), surround.rows - 1.0);
      const int x0 = static_cast<int>(px), y0 = static_cast<int>(py);
      const int x1 = std::min(x0 + 1, surround.cols - 1), y1 = std::min(y0 + 1, surround.rows - 1);
      const double fx = px - x0, fy = py - y0;
      out.at<double>(y, x) =
          (1 - fy) * ((1 - fx) * surround.at<double>(y0, x0) + fx * surround.at<double>(y0, x1)) +
          fy * ((1 - fx) * surround.at<double>(y1, x0) + fx * surround.at<double>(y1, x1));
    }
  }
  return out;
}

double promotion(const cv::Mat& map, double noise_floor) {
  double maximum = 0.0;
  cv::Point first;
  cv::minMaxLoc(map, nullptr, &maximum, nullptr, &first);
  if (maximum <= 0.0 || maximum < noise_floor) return 0.0;
  double sum = 0.0;
  int count = 0;
  for (int y = 1; y + 1 < map.rows; ++y) {
    for (int x = 1; x + 1 < map.cols; ++x) {
      const double v = map.at<double>(y, x);
      const std::array<double, 4> around{map.at<double>(y - 1, x), map.at<double>(y + 1, x),
                                         map.at<double>(y, x - 1), map.at<double>(y, x + 1)};
      const auto [lowest, highest] = std::minmax_element(around.begin(), around.end());
      if (v <= maximum / 10.0 || v < *highest || v <= *lowest) continue;
      if (cv::Point(x, y) == first) continue;
      sum += v;
      ++count;
    }
  }
  const double mean = count > 0 ? sum / count : 0.0;
  return kMaximum / maximum * std::pow((maximum - mean) / maximum, 2);
}

Planes level_two(const cv::Mat& rgb, const SaliencySettings& settings) {
  if (settings.profile == SaliencyProfile::robust) {
    cv::Mat smooth;
    rgb.convertTo(smooth, CV_64FC3);
    smooth = pyr_down(pyr_down(smooth));
    std::array<cv::Mat, 3> planes;
    cv::split(smooth, planes.data());
    return late_opponents(planes[0], planes[1], planes[2]);
  }
  cv::Mat opponents(rgb.size(), CV_64FC3);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x)
      opponents.at<cv::Vec3d>(y, x) =
          pixel_opponents(rgb.at<cv::Vec3b>(y, x), settings.clamp_negative);
  opponents = pyr_down(pyr_down(opponents));
  std::array<cv::Mat, 3> planes;
  cv::split(opponents, planes.data());
  return {planes[0], planes[1], planes[2]};
}

Planes level_two_yuyv(const cv::Mat& yuyv) {
  cv::Mat y(yuyv.size(), CV_64F);
  cv::Mat u(yuyv.rows, yuyv.cols / 2, CV_64F), v = u.clone();
  for (int row = 0; row < yuyv.rows; ++row) {
    for (int x = 0; x < yuyv.cols; ++x) {
      const auto& sample = yuyv.at<cv::Vec2b>(row, x);
      y.at<double>(row, x) = (sample[0] - 16) * 255.0 / 219.0;
      (x % 2 == 0 ? u : v).at<double>(row, x / 2) = (sample[1] - 128) * 255.0 / 224.0;
    }
  }
  // Chroma comes with every second pixel of a row: its first step is along the columns only.
  const auto half_rows = [](const cv::Mat& plane) {
    const cv::Mat kernel = (cv::Mat_<double>(1, 5) << 1, 4, 6, 4, 1) / 16.0;
    cv::Mat filtered;
    cv::sepFilter2D(plane, filtered, CV_64F, cv::Mat::ones(1, 1, CV_64F), kernel, {-1, -1}, 0.0,
                    cv::BORDER_REFLECT_101);
    cv::Mat half((plane.rows + 1) / 2, plane.cols, CV_64F);
    for (int row = 0; row < half.rows; ++row) filtered.row(2 * row).copyTo(half.row(row));
    return half;
  };
  y = pyr_down(pyr_down(y));
  u = pyr_down(half_rows(u));
  v = pyr_down(half_rows(v));
  return late_opponents(y + 1.402 * v, y - 0.344136 * u - 0.714136 * v, y + 1.772 * u);
}

Result look_rgb(const cv::Mat& rgb, const SaliencySettings& settings) {
  return combine(level_two(rgb, settings), settings);
}

Result look_yuyv(const cv::Mat& yuyv, const SaliencySettings& settings) {
  return combine(level_two_yuyv(yuyv), settings);
}

}  // namespace gazed::saliency::reference
