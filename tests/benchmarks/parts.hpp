// Frames with an object and without: cut out of photographs whose object has a mask, and rendered.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

namespace gazed::benchmarks {

/// The largest of what is left, right, above and below of the object's bounding box; none where its
/// shorter side is under 100 px; the picture where the mask is empty.
[[nodiscard]] std::optional<cv::Mat> without_object(const cv::Mat& picture, const cv::Mat& mask);

/// A window that shows 40 to 75 % of the object's bounding box; none where no try found one.
[[nodiscard]] std::optional<cv::Rect> cutting_window(const cv::Mat& mask, std::uint64_t seed);

enum class Furnished : std::uint8_t { with_all, walls_alone };

/// What the robot sees first in a trial of a row of the accuracy benchmark, blue, green, red.
[[nodiscard]] cv::Mat rendered_room(const std::string& row, std::uint64_t number,
                                    Furnished furnished);

}  // namespace gazed::benchmarks
