// From a camera's JPEG frames (MJPG) to pixels, by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "agent/base/image.hpp"

namespace gazed::jpeg {

/// Decodes a frame of `width_px` x `height_px` into `image`, which becomes rgb24, or grey where the
/// frame has no colours. The bytes may be anything: what is no JPEG of this size, damaged, cut, or
/// of a kind that cameras do not send (progressive, several scans, arithmetic coding, CMYK) is
/// refused, before memory is taken for it. A frame without Huffman tables has the usual ones, and
/// the end marker may be missing. Nothing but libjpeg allocates for the second frame of a kind, and
/// that gives back what it took.
///
/// Empty, or why there is no image, in words; the pixels are then of no use.
[[nodiscard]] std::string decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                                 base::Image& image);

}  // namespace gazed::jpeg
