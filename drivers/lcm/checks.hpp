// Reading messages that others sent, or that a file holds, without trusting them.
//
// lcm-gen's decoders allocate what a message claims to hold before they look whether it does: 100
// bytes that claim an image of 2 GB would end the daemon. Images are therefore read here, in place;
// a head state has no variable part and is read by the generated decoder.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "drivers/camera.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/conversions.hpp"

namespace gazed::lcm {

/// Why a message is not used, in words and numbers.
struct Refusal {
  std::string reason;
};

/// What a message has of a frame. The bytes are borrowed from the message.
struct WireImage {
  geometry::Frame frame;  // without pixels where there is a JPEG
  Coding coding = Coding::plain;
  std::span<const std::uint8_t> jpeg{};
};

/// A bot_core.image_t in YUYV, UYVY, RGB3, BGR3 or GREY with whatever row_stride, or in MJPG. The
/// pixels of UYVY and BGR3 are still to be swapped, a JPEG is still to be decoded and may be
/// anything.
[[nodiscard]] std::variant<WireImage, Refusal> read_image(std::span<const std::uint8_t> message);

/// A gazed.head_state_t with finite angles within +-pi. Velocities may be NaN.
[[nodiscard]] std::variant<geometry::HeadState, Refusal> read_head_state(
    std::span<const std::uint8_t> message);

}  // namespace gazed::lcm
