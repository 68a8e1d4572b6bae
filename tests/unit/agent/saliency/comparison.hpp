// The fixed-point stage beside its double-precision reference.
#pragma once

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <string>

#include "agent/base/image.hpp"
#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

/// The suffix of a parametrised test.
[[nodiscard]] inline std::string profile_name(
    const testing::TestParamInfo<SaliencyProfile>& profile) {
  return std::string(profile_names[static_cast<std::size_t>(profile.param)]);
}

struct Comparison {
  double correlation = 0.0;  // Pearson's, of the two maps
  int winner_distance = 0;   // in samples, the larger axis
  double saliency = 0.0;
  double reference_saliency = 0.0;
};

/// `rgb`: an rgb24 frame.
[[nodiscard]] Comparison compare(const base::ImageView& rgb, const SaliencySettings& settings);

/// S as CV_64F, 255 at most.
[[nodiscard]] cv::Mat as_mat(const SaliencyMap& map);

/// 1 for two maps without any contrast.
[[nodiscard]] double correlation(const cv::Mat& a, const cv::Mat& b);

}  // namespace gazed::saliency
