// The pictures of a data folder, as gazelab saliency looks at them.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "agent/saliency/saliency.hpp"

namespace gazed::benchmarks {

/// The .jpg files of a folder, sorted. Throws std::runtime_error that names the folder when it is
/// missing or has none.
[[nodiscard]] std::vector<std::filesystem::path> pictures(const std::filesystem::path& folder);

/// Those of the folders of `data` that are there.
[[nodiscard]] std::vector<std::filesystem::path> pictures_of(
    const std::filesystem::path& data, const std::vector<std::string>& folders);

/// A picture and its working frame, RGB, whose longer side is 640.
struct Picture {
  cv::Mat original, frame;
  double scale;

  explicit Picture(const std::filesystem::path& file);
  explicit Picture(const cv::Mat& bgr);

  /// In the original's pixels.
  [[nodiscard]] geometry::Pixel winner(const saliency::SaliencySettings& settings) const;
};

}  // namespace gazed::benchmarks
