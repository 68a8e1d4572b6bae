#include "drivers/lcm/conversions.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "drivers/lcm/big_endian.hpp"

namespace gazed::lcm {

namespace {

/// Without padding.
std::size_t row_bytes(const base::ImageView& image) {
  return static_cast<std::size_t>(image.width_px) *
         static_cast<std::size_t>(base::bytes_per_pixel(image.format));
}

}  // namespace

std::int32_t four_cc(base::PixelFormat format) {
  switch (format) {
    case base::PixelFormat::grey:
      return bot_core::image_t::PIXEL_FORMAT_GREY;
    case base::PixelFormat::rgb24:
      return bot_core::image_t::PIXEL_FORMAT_RGB3;
    case base::PixelFormat::yuyv:
      break;
  }
  return bot_core::image_t::PIXEL_FORMAT_YUYV;
}

std::optional<WireFormat> wire_format(std::int32_t four_cc) {
  constexpr std::int32_t bgr3 = 'B' | 'G' << 8 | 'R' << 16 | '3' << 24;
  constexpr std::int32_t uyvy = 'U' | 'Y' << 8 | 'V' << 16 | 'Y' << 24;
  switch (four_cc) {
    case bot_core::image_t::PIXEL_FORMAT_GREY:
      return WireFormat{base::PixelFormat::grey};
    case bot_core::image_t::PIXEL_FORMAT_RGB3:
      return WireFormat{base::PixelFormat::rgb24};
    case bot_core::image_t::PIXEL_FORMAT_YUYV:
      return WireFormat{base::PixelFormat::yuyv};
    case bgr3:
      return WireFormat{base::PixelFormat::rgb24, Coding::swapped};
    case uyvy:
      return WireFormat{base::PixelFormat::yuyv, Coding::swapped};
    case bot_core::image_t::PIXEL_FORMAT_MJPG:
      return WireFormat{base::PixelFormat::rgb24, Coding::jpeg};
    default:
      return std::nullopt;
  }
}

void swap_bytes(std::span<std::uint8_t> pixels, base::PixelFormat format) {
  const bool rgb = format == base::PixelFormat::rgb24;
  const std::size_t step = rgb ? 3 : 2, other = rgb ? 2 : 1;
  for (std::size_t i = 0; i + other < pixels.size(); i += step) {
    std::swap(pixels[i], pixels[i + other]);
  }
}

void to_message(const geometry::Frame& frame, bot_core::image_t& message) {
  const base::ImageView& image = frame.image;
  message.utime = frame.utime_us;
  message.width = image.width_px;
  message.height = image.height_px;
  message.row_stride = image.width_px * base::bytes_per_pixel(image.format);
  message.pixelformat = four_cc(image.format);
  message.size = message.row_stride * image.height_px;
  message.data.resize(static_cast<std::size_t>(message.size));
  auto out = message.data.begin();
  for (int y = 0; y < image.height_px; ++y) {
    out = std::copy_n(image.row(y), message.row_stride, out);
  }
  message.nmetadata = 0;
  message.metadata.clear();
}

std::size_t encoded_bytes(const base::ImageView& image) {
  // Fingerprint and time; width, height, stride, format, size; behind the pixels, how many
  // metadata.
  constexpr std::size_t numbers = 2 * sizeof(std::int64_t) + 6 * sizeof(std::int32_t);
  return numbers + row_bytes(image) * static_cast<std::size_t>(image.height_px);
}

void encode_image(const geometry::Frame& frame, std::span<std::uint8_t> out) {
  const base::ImageView& image = frame.image;
  const std::size_t stride = row_bytes(image);
  const auto put = [&out](auto number) {
    write_big_endian(number, out);
    out = out.subspan(sizeof number);
  };
  put(bot_core::image_t::getHash());
  put(frame.utime_us);
  for (const std::size_t number : {static_cast<std::size_t>(image.width_px),
                                   static_cast<std::size_t>(image.height_px), stride})
    put(static_cast<std::int32_t>(number));
  put(four_cc(image.format));
  put(static_cast<std::int32_t>(stride * static_cast<std::size_t>(image.height_px)));
  for (int y = 0; y < image.height_px; ++y, out = out.subspan(stride))
    std::copy_n(image.row(y), stride, out.begin());
  put(std::int32_t{0});  // no metadata
}

void to_message(const geometry::Frame& frame, std::span<const std::uint8_t> jpeg,
                bot_core::image_t& message) {
  message.utime = frame.utime_us;
  message.width = frame.image.width_px;
  message.height = frame.image.height_px;
  message.row_stride = 0;  // a JPEG has no rows of bytes
  message.pixelformat = bot_core::image_t::PIXEL_FORMAT_MJPG;
  message.size = static_cast<std::int32_t>(jpeg.size());
  message.data.assign(jpeg.begin(), jpeg.end());
  message.nmetadata = 0;
  message.metadata.clear();
}

void to_message(const geometry::HeadState& state, head_state_t& message) {
  message.utime = state.utime_us;
  message.yaw_rad = state.measured.yaw_rad;
  message.pitch_rad = state.measured.pitch_rad;
  message.yaw_velocity_rad_s = state.velocity_rad_s.yaw_rad;
  message.pitch_velocity_rad_s = state.velocity_rad_s.pitch_rad;
  message.stiffness = state.stiffness;
  message.temperature_c = state.temperature_c;
}

void to_message(const geometry::HeadCommand& command, head_command_t& message) {
  message.utime = command.utime_us;
  message.yaw_rad = command.target.yaw_rad;
  message.pitch_rad = command.target.pitch_rad;
  message.speed_fraction = command.speed_fraction;
}

geometry::HeadState from_message(const head_state_t& message) {
  return {.utime_us = message.utime,
          .measured = {message.yaw_rad, message.pitch_rad},
          .velocity_rad_s = {message.yaw_velocity_rad_s, message.pitch_velocity_rad_s},
          .stiffness = message.stiffness,
          .temperature_c = message.temperature_c};
}

geometry::HeadCommand from_message(const head_command_t& message) {
  return {.utime_us = message.utime,
          .target = {message.yaw_rad, message.pitch_rad},
          .speed_fraction = message.speed_fraction};
}

}  // namespace gazed::lcm
