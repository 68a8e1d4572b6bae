// Whether a JPEG that has lost its end has lost any of its picture.
#pragma once

#include <cstdint>
#include <span>

namespace gazed::lab::io {

/// True when every block of the picture is there, of a progressive one to its last bit, whatever
/// comes behind or does not: cameras that send Motion JPEG leave the end-of-image marker out.
[[nodiscard]] bool has_all_blocks(std::span<const std::uint8_t> bytes);

}  // namespace gazed::lab::io
