// An image as returned by ALVideoDevice.getImageRemote(): a list of width, height, layers, colour
// space, seconds, microseconds, pixels, and more (naoqi_driver, from_any_value.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "agent/base/image.hpp"
#include "drivers/naoqi/service.hpp"

namespace gazed::naoqi {

inline constexpr int naoqi_yuv422 = 9;  // ALVideoDevice's number for YUYV

struct NaoqiImage {
  base::ImageView image;      // points into the answer
  std::int64_t stamp_us = 0;  // by the robot's clock
};

/// Reads an image. Numbers may have any width; pixels may be "r" or "s" (the Python server's).
/// Otherwise returns why it is not a YUYV image of this size.
[[nodiscard]] std::variant<NaoqiImage, std::string> read_image(const QiResult& result, int width_px,
                                                               int height_px);

}  // namespace gazed::naoqi
