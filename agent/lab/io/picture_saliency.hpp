// What stands out in pictures of any size.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "agent/geometry/camera.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::lab::io {

struct SalientPicture {
  saliency::SaliencyResult seen;  // in the working frame; borrowed until the next picture
  double scale = 1.0;             // from the picture to the working frame
  geometry::Pixel winner_px = geometry::Pixel::Zero();  // in the picture
};

/// Scales each picture to the working frame; keeps the working state while that size stays the
/// same.
class PictureSaliency {
 public:
  explicit PictureSaliency(const saliency::SaliencySettings& settings) : settings_(settings) {}

  /// `bgr`: 8UC3, blue green red. Throws std::invalid_argument, with both sizes, for a shape whose
  /// working frame is too small.
  [[nodiscard]] SalientPicture examine(const cv::Mat& bgr);

 private:
  saliency::SaliencySettings settings_;
  cv::Size size_;
  std::optional<saliency::Saliency> saliency_;
};

}  // namespace gazed::lab::io
