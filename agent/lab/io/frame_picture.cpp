#include "agent/lab/io/frame_picture.hpp"

#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace gazed::lab::io {

cv::Mat bgr_of(const base::ImageView& frame) {
  const int type = CV_8UC(base::bytes_per_pixel(frame.format));
  // OpenCV has no header for pixels that are only read.
  const cv::Mat borrowed(frame.height_px, frame.width_px, type,
                         const_cast<std::uint8_t*>(frame.data),
                         static_cast<std::size_t>(frame.row_stride));
  cv::Mat bgr;
  switch (frame.format) {
    case base::PixelFormat::grey:
      cv::cvtColor(borrowed, bgr, cv::COLOR_GRAY2BGR);
      break;
    case base::PixelFormat::rgb24:
      cv::cvtColor(borrowed, bgr, cv::COLOR_RGB2BGR);
      break;
    case base::PixelFormat::yuyv:
      cv::cvtColor(borrowed, bgr, cv::COLOR_YUV2BGR_YUY2);
      break;
  }
  return bgr;
}

}  // namespace gazed::lab::io
