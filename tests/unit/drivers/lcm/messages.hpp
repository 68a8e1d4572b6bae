// Messages for the tests of this folder and of tests/unit/drivers/log.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "agent/base/image.hpp"
#include "drivers/head.hpp"
#include "drivers/lcm/conversions.hpp"
#include "msgs/bot_core/image_t.hpp"
#include "msgs/gazed/head_state_t.hpp"

namespace gazed::lcm {

constexpr std::int64_t start_us = 1'700'000'000'000'000;
constexpr std::int64_t frame_us = 33'333;  // 30 Hz

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// An image whose bytes all differ from their neighbours, rows unpadded.
inline base::Image test_image(int width_px, int height_px, base::PixelFormat format, int seed = 0) {
  base::Image image(width_px, height_px, format);
  int value = seed;
  for (std::uint8_t& byte : image.pixels()) byte = static_cast<std::uint8_t>(value += 7);
  return image;
}

inline bot_core::image_t image_message(int width_px, int height_px, base::PixelFormat format,
                                       std::int64_t utime_us = start_us) {
  const base::Image image = test_image(width_px, height_px, format);
  bot_core::image_t message;
  to_message(geometry::Frame{image.view(), utime_us}, message);
  return message;
}

inline head_state_t head_message(double yaw_rad, double pitch_rad,
                                 std::int64_t utime_us = start_us) {
  head_state_t message{};
  message.utime = utime_us;
  message.yaw_rad = yaw_rad;
  message.pitch_rad = pitch_rad;
  message.stiffness = 0.7F;
  message.temperature_c = 38.0F;
  return message;
}

inline geometry::HeadState head_state(std::int64_t utime_us) {
  geometry::HeadState state;
  state.utime_us = utime_us;
  return state;
}

/// The pixels of two images are the same; padding does not count.
inline bool same_pixels(const base::ImageView& a, const base::ImageView& b) {
  if (a.width_px != b.width_px || a.height_px != b.height_px || a.format != b.format) return false;
  const int row_bytes = a.width_px * base::bytes_per_pixel(a.format);
  for (int y = 0; y < a.height_px; ++y) {
    if (!std::equal(a.row(y), a.row(y) + row_bytes, b.row(y))) return false;
  }
  return true;
}

/// Damages bytes the way links and disks do, and worse: bytes, lengths, cuts, insertions.
inline void mutate(std::vector<std::uint8_t>& bytes, std::mt19937_64& random) {
  constexpr std::array<std::uint8_t, 5> nasty = {0x00, 0x01, 0x7F, 0x80, 0xFF};
  const std::size_t changes = 1 + random() % 4;
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = random() % bytes.size();
    const auto there = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random() % 5) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 1:
        bytes[at] = nasty[random() % nasty.size()];
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.insert(there, static_cast<std::uint8_t>(random()));
        break;
      default:  // a whole 32-bit number: mostly a size
        for (std::size_t k = at; k < std::min(at + 4, bytes.size()); ++k) {
          bytes[k] = nasty[random() % nasty.size()];
        }
    }
  }
}

}  // namespace gazed::lcm
