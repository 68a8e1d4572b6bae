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

namespace gazed::lcm {

/// Why a message is not used, in words and numbers.
struct Refusal {
  std::string reason;
};

/// A bot_core.image_t in YUYV, UYVY, RGB3, BGR3 or GREY with whatever row_stride. The image borrows
/// its pixels from `message`; those of UYVY and BGR3 are still to be swapped.
[[nodiscard]] std::variant<geometry::Frame, Refusal> read_image(
    std::span<const std::uint8_t> message);
/// Whether the pixels of a message that read_image() accepts are to be swapped (swap_bytes()).
[[nodiscard]] bool has_swapped_bytes(std::span<const std::uint8_t> message);

/// A gazed.head_state_t with finite angles within +-pi. Velocities may be NaN.
[[nodiscard]] std::variant<geometry::HeadState, Refusal> read_head_state(
    std::span<const std::uint8_t> message);

}  // namespace gazed::lcm
