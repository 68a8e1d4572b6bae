// Both profiles in double precision, written from the mathematics alone and without the shortcuts
// of the fixed-point stage: what that stage is compared with.
#pragma once

#include <opencv2/core.hpp>

#include "agent/saliency/saliency.hpp"

namespace gazed::saliency::reference {

struct Result {
  cv::Mat map;       // CV_64F, S with M = 255
  cv::Point winner;  // the map's sample
};

/// `rgb`: CV_8UC3 in the order r, g, b.
[[nodiscard]] Result look_rgb(const cv::Mat& rgb, const SaliencySettings& settings);

/// Robust profile from the camera's planes. `yuyv`: CV_8UC2, even width.
[[nodiscard]] Result look_yuyv(const cv::Mat& yuyv, const SaliencySettings& settings);

/// The three planes at level 2, intensity in grey levels, opponents in full scale.
struct Planes {
  cv::Mat intensity, red_green, blue_yellow;  // CV_64F
};
[[nodiscard]] Planes level_two(const cv::Mat& rgb, const SaliencySettings& settings);
[[nodiscard]] Planes level_two_yuyv(const cv::Mat& yuyv);

/// N's factor (M - m)^2 / M^2 times 255 / M; 0 when M is 0 or below the floor.
[[nodiscard]] double promotion(const cv::Mat& map, double noise_floor);

/// `surround` at the size of `centre`, 2^ratio_log2 times finer, bilinearly.
[[nodiscard]] cv::Mat interpolated(const cv::Mat& surround, int ratio_log2, cv::Size centre);

}  // namespace gazed::saliency::reference
