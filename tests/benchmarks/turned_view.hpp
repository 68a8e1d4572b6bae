// What a NAO V6 would see of a photograph before and after the step rule's move: far away, so that
// its camera only turns.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "agent/saliency/saliency.hpp"

namespace gazed::benchmarks {

struct TurnedViews {
  cv::Mat first, second;                  // RGB, 640x480, with noise of 2 grey levels
  geometry::Pixel winner, winner_turned;  // of the first, and where it is in the second
};

/// The picture, 800x600 of it, is larger than the camera's window by what both views need. The head
/// turns by 0.1 rad on both axes towards the first view's winner, from the side of the picture that
/// leaves room for it. None where no such side's winner is on the way, or the border of the second
/// view may cut it (64 px).
[[nodiscard]] std::optional<TurnedViews> turned_views(const cv::Mat& bgr,
                                                      const saliency::SaliencySettings& settings,
                                                      std::uint64_t seed);

/// Normal noise, each channel of each pixel its own.
[[nodiscard]] cv::Mat with_noise(const cv::Mat& rgb, double grey_levels, std::uint64_t seed);

inline constexpr double reach_of_border_px = 64.0;

}  // namespace gazed::benchmarks
