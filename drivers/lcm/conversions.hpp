// Between the messages of msgs/ and the types that drivers and the cycle speak.
//
// The messages are arguments, not results, so that one message object can be used for ever: after
// the first image of a size nothing is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "agent/base/image.hpp"
#include "drivers/camera.hpp"
#include "drivers/head.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/head_command_t.hpp"
#include "msgs/gazed/head_state_t.hpp"

namespace gazed::lcm {

/// The FourCC of image_t.pixelformat.
[[nodiscard]] std::int32_t four_cc(base::PixelFormat format);
/// How the bytes of a message stand for the pixels.
enum class Coding : std::uint8_t {
  plain,
  swapped,  // BGR instead of RGB, UYVY instead of YUYV: see swap_bytes()
  jpeg,     // MJPG: a JPEG file a frame
};
struct WireFormat {
  base::PixelFormat format;  // rgb24 of a JPEG, which may be grey as well
  Coding coding = Coding::plain;
};
/// None for a FourCC that gazed does not read.
[[nodiscard]] std::optional<WireFormat> wire_format(std::int32_t four_cc);
/// Makes RGB of BGR, and YUYV of UYVY. `pixels`: rows unpadded.
void swap_bytes(std::span<std::uint8_t> pixels, base::PixelFormat format);

/// Rows are written without padding.
void to_message(const geometry::Frame& frame, bot_core::image_t& message);
/// The same message as LCM sends it, without a copy of the pixels in between: what it takes, and
/// how it is written there.
[[nodiscard]] std::size_t encoded_bytes(const base::ImageView& image);
void encode_image(const geometry::Frame& frame, std::span<std::uint8_t> out);
/// `jpeg` is the file that stands for the frame's pixels.
void to_message(const geometry::Frame& frame, std::span<const std::uint8_t> jpeg,
                bot_core::image_t& message);
void to_message(const geometry::HeadState& state, head_state_t& message);
void to_message(const geometry::HeadCommand& command, head_command_t& message);

[[nodiscard]] geometry::HeadState from_message(const head_state_t& message);
[[nodiscard]] geometry::HeadCommand from_message(const head_command_t& message);

}  // namespace gazed::lcm
