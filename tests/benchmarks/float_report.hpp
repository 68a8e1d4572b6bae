// A peer of the saliency stage: the report profile in OpenCV's 32-bit floats, written with
// cv::pyrDown, cv::resize and cv::absdiff as a user of OpenCV would.
#pragma once

#include <opencv2/core.hpp>

namespace gazed::benchmarks {

/// S at scale 4, CV_32F, 255 at most. `rgb`: CV_8UC3 in the order r, g, b. Surrounds are
/// interpolated as cv::resize does it, half a sample beside where the report profile looks.
[[nodiscard]] cv::Mat float_report(const cv::Mat& rgb);

}  // namespace gazed::benchmarks
