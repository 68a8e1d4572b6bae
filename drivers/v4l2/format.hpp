// The size, pixel format and rate of a video device.
#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "drivers/v4l2/video_device.hpp"

namespace gazed::v4l2 {

/// The size asked for, as YUYV, rows perhaps padded, or as JPEG.
struct VideoFormat {
  int width_px = 0;
  int height_px = 0;
  int row_stride = 0;  // bytes; 0: JPEG

  [[nodiscard]] bool is_jpeg() const { return row_stride == 0; }
  /// The least that a frame has: to the end of the last row's pixels; of a JPEG its two markers.
  [[nodiscard]] std::size_t bytes() const {
    constexpr std::size_t markers = 4;
    if (is_jpeg()) return markers;
    return static_cast<std::size_t>(row_stride) * static_cast<std::size_t>(height_px - 1) +
           2U * static_cast<std::size_t>(width_px);
  }
};

struct VideoProblem {
  std::string what;
};

/// Sets YUYV of exactly this size, one whole frame a buffer, or else JPEG (MJPG). Where the camera
/// has neither, the problem lists what it offers.
[[nodiscard]] std::variant<VideoFormat, VideoProblem> set_format(const VideoDevice& device,
                                                                 int width_px, int height_px);

/// Asks for 30 frames a second. Empty, or what the camera gives instead.
[[nodiscard]] std::string set_frame_rate(const VideoDevice& device);

/// "YUYV 640x480, 320x240; MJPG 1280x720".
[[nodiscard]] std::string offered_formats(const VideoDevice& device);

}  // namespace gazed::v4l2
