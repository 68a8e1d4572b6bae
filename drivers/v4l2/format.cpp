#include "drivers/v4l2/format.hpp"

#include <cerrno>
#include <cstdint>
#include <linux/videodev2.h>

#include "agent/base/text.hpp"

namespace gazed::v4l2 {

namespace {

constexpr std::uint32_t frames_per_second = 30;
// Of a camera's list; more are not of use to who reads a message, and a list may not end.
constexpr std::uint32_t formats_max = 16;
constexpr std::uint32_t sizes_max = 32;
constexpr std::uint32_t row_stride_max = 1U << 20;

std::string four_letters(std::uint32_t four_cc) {
  std::string letters;
  for (int shift = 0; shift < 32; shift += 8) {
    const auto letter = static_cast<char>(four_cc >> shift & 0x7F);
    letters += letter > ' ' && letter < 127 ? letter : '?';
  }
  return letters;
}

std::string size_text(std::uint32_t width_px, std::uint32_t height_px) {
  return base::text("%ux%u", width_px, height_px);
}

/// "640x480, 320x240", "48x32 to 1920x1080"; empty where the driver does not tell.
std::string offered_sizes(const VideoDevice& device, std::uint32_t pixel_format) {
  std::string sizes;
  for (std::uint32_t i = 0; i < sizes_max; ++i) {
    v4l2_frmsizeenum size{};
    size.index = i;
    size.pixel_format = pixel_format;
    if (device.request(VIDIOC_ENUM_FRAMESIZES, size) != 0) break;
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      const v4l2_frmsize_stepwise& range = size.stepwise;
      return base::text("%ux%u to %ux%u", range.min_width, range.min_height, range.max_width,
                        range.max_height);
    }
    sizes.append(i == 0 ? "" : ", ").append(size_text(size.discrete.width, size.discrete.height));
  }
  return sizes;
}

std::string wanted_text(int width_px, int height_px) {
  return base::text("YUYV or MJPG %dx%d was asked for", width_px, height_px);
}

v4l2_pix_format wanted(std::uint32_t four_cc, int width_px, int height_px) {
  v4l2_pix_format pixels{};
  pixels.width = static_cast<std::uint32_t>(width_px);
  pixels.height = static_cast<std::uint32_t>(height_px);
  pixels.pixelformat = four_cc;
  pixels.field = V4L2_FIELD_NONE;
  return pixels;
}

/// 0, and what the camera gives instead, or an errno.
int ask_for(const VideoDevice& device, v4l2_pix_format& pixels) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix = pixels;
  const int error = device.request(VIDIOC_S_FMT, format);
  pixels = format.fmt.pix;
  return error;
}

/// A driver gives what comes nearest.
bool is_as_wanted(const v4l2_pix_format& pixels, std::uint32_t four_cc, int width_px,
                  int height_px) {
  return pixels.pixelformat == four_cc && pixels.width == static_cast<std::uint32_t>(width_px) &&
         pixels.height == static_cast<std::uint32_t>(height_px);
}

VideoProblem refused(const VideoDevice& device, int error, int width_px, int height_px) {
  return {wanted_text(width_px, height_px) + ": " + camera_error(error) + "; the camera offers " +
          offered_formats(device)};
}

/// How a frame of YUYV lies in a buffer.
std::variant<VideoFormat, VideoProblem> rows_of(const v4l2_pix_format& pixels) {
  const std::uint32_t row_bytes = 2 * pixels.width;
  // Drivers of progressive cameras say NONE, or INTERLACED out of habit; all others have half of
  // the rows in a buffer, or the halves one below the other.
  if (pixels.field != V4L2_FIELD_NONE && pixels.field != V4L2_FIELD_ANY &&
      pixels.field != V4L2_FIELD_INTERLACED) {
    return VideoProblem{base::text("the camera gives half frames (field order %u)", pixels.field)};
  }
  const std::uint32_t stride = pixels.bytesperline == 0 ? row_bytes : pixels.bytesperline;
  if (stride < row_bytes || stride > row_stride_max) {
    return VideoProblem{base::text("the camera gives rows of %u bytes; %u pixels need %u", stride,
                                   pixels.width, row_bytes)};
  }
  return VideoFormat{static_cast<int>(pixels.width), static_cast<int>(pixels.height),
                     static_cast<int>(stride)};
}

}  // namespace

std::string offered_formats(const VideoDevice& device) {
  std::string formats;
  for (std::uint32_t i = 0; i < formats_max; ++i) {
    v4l2_fmtdesc format{};
    format.index = i;
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (device.request(VIDIOC_ENUM_FMT, format) != 0) break;
    const std::string sizes = offered_sizes(device, format.pixelformat);
    formats.append(i == 0 ? "" : "; ").append(four_letters(format.pixelformat));
    if (!sizes.empty()) formats.append(" ").append(sizes);
  }
  return formats.empty() ? "nothing that it lists" : formats;
}

std::variant<VideoFormat, VideoProblem> set_format(const VideoDevice& device, int width_px,
                                                   int height_px) {
  v4l2_pix_format pixels = wanted(V4L2_PIX_FMT_YUYV, width_px, height_px);
  const int error = ask_for(device, pixels);
  if (error != 0 && error != EINVAL) return refused(device, error, width_px, height_px);
  if (error != 0 || !is_as_wanted(pixels, V4L2_PIX_FMT_YUYV, width_px, height_px)) {
    v4l2_pix_format coded = wanted(V4L2_PIX_FMT_MJPEG, width_px, height_px);
    if (ask_for(device, coded) == 0 &&
        is_as_wanted(coded, V4L2_PIX_FMT_MJPEG, width_px, height_px)) {
      return VideoFormat{width_px, height_px, 0};
    }
    if (error != 0) return refused(device, error, width_px, height_px);
    return VideoProblem{wanted_text(width_px, height_px) + ", the camera gives " +
                        four_letters(pixels.pixelformat) + " " +
                        size_text(pixels.width, pixels.height) + "; it offers " +
                        offered_formats(device)};
  }
  return rows_of(pixels);
}

std::string set_frame_rate(const VideoDevice& device) {
  v4l2_streamparm wish{};
  wish.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  wish.parm.capture.timeperframe = {1, frames_per_second};
  if (device.request(VIDIOC_S_PARM, wish) != 0) return "its frame rate cannot be set";
  const v4l2_fract& interval = wish.parm.capture.timeperframe;
  if (interval.numerator == 0 || interval.denominator == 0) return "its frame rate cannot be set";
  const double rate = static_cast<double>(interval.denominator) / interval.numerator;
  // 29.97 is 30 to a camera.
  if (rate > 29.5 && rate < 30.5) return {};
  return base::text("it gives %.1f frames a second; %u were asked for", rate, frames_per_second);
}

}  // namespace gazed::v4l2
