// Where a winner may and may not be. Winners here are pixels of the picture as it was read, before
// it is scaled to the working frame.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "agent/geometry/camera.hpp"

namespace gazed::benchmarks {

/// The hand-drawn mask of a picture: FOLDER/<stem>.png, above 127 on the object. Throws
/// std::runtime_error that names the file when it cannot be read.
[[nodiscard]] cv::Mat mask_of(const std::filesystem::path& picture,
                              const std::filesystem::path& folder);

[[nodiscard]] bool inside_mask(const geometry::Pixel& winner_px, const cv::Mat& mask);

/// Within 24 px of the border, in the frame whose longer side is 640.
[[nodiscard]] bool near_border(const geometry::Pixel& winner_px, const cv::Mat& picture);

}  // namespace gazed::benchmarks
