// An image as ALVideoDevice.getImageRemote() gives it: a list of width, height, layers, colour
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
  base::ImageView image;      // borrowed from the answer
  std::int64_t stamp_us = 0;  // by the robot's clock
};

/// Numbers may be of any width, pixels "r" or "s" (the Python server's). Otherwise why it is no
/// image of this size in YUYV.
[[nodiscard]] std::variant<NaoqiImage, std::string> read_image(const QiResult& result, int width_px,
                                                               int height_px);

}  // namespace gazed::naoqi
