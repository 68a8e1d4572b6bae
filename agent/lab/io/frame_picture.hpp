// A frame of a camera as a picture of OpenCV's.
#pragma once

#include <opencv2/core/mat.hpp>

#include "agent/base/image.hpp"

namespace gazed::lab::io {

/// 8UC3, blue green red, a copy; grey frames become grey in colour.
[[nodiscard]] cv::Mat bgr_of(const base::ImageView& frame);

}  // namespace gazed::lab::io
