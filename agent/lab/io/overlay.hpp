// A picture that shows a person what the saliency map says about a photograph.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "agent/saliency/saliency.hpp"

namespace gazed::lab::io {

struct OverlayLabels {
  geometry::Pixel winner_px = geometry::Pixel::Zero();  // in the photograph's pixels
  float saliency = 0.0F;
  float distinctness = 0.0F;
  double distinctness_min = 0.0;  // below it there is no salient object
  std::string more{};             // at the end of the caption
};

/// The photograph (8UC3, blue green red) with the map as heat over it, a ring with a cross on the
/// winner and a caption; same size, same type. `scale` is the factor from the photograph to the
/// frame that the map was made of.
[[nodiscard]] cv::Mat overlay_of(const cv::Mat& photograph, const saliency::SaliencyMap& map,
                                 double scale, const OverlayLabels& labels);
/// The same, labelled by what was seen in that frame; `more` ends the caption.
[[nodiscard]] cv::Mat overlay_of(const cv::Mat& photograph, const saliency::SaliencyResult& seen,
                                 double scale, double distinctness_min,
                                 const std::string& more = {});

}  // namespace gazed::lab::io
