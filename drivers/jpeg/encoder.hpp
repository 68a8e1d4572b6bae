// From pixels to JPEG, by libjpeg-turbo, for those who watch over a network.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agent/base/image.hpp"

namespace gazed::jpeg {

/// Writes one image after another; its buffers are kept.
class Encoder {
 public:
  /// `quality`: 1 to 100, as libjpeg counts.
  explicit Encoder(int quality) : quality_(quality) {}

  /// `image` as a whole JPEG file; valid until the next call. Colours of yuyv stay halved in width,
  /// those of rgb24 are halved in both directions. Empty where libjpeg fails: for want of memory,
  /// or for an image of over 65500 pixels a side.
  [[nodiscard]] std::span<const std::uint8_t> encode(const base::ImageView& image);

 private:
  int quality_;
  std::vector<std::uint8_t> file_;
  std::vector<std::uint8_t> row_;  // of yuyv: y u v of each pixel, full range
};

}  // namespace gazed::jpeg
