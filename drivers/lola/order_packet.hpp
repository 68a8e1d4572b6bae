// The packet with the joints' set points for LoLA: {Position, Stiffness}, 276 bytes.
#pragma once

#include <array>
#include <cstddef>

#include "drivers/lola/body.hpp"

namespace gazed::lola {

/// A map with two entries; each has a key of 8 or 9 letters and 25 numbers.
inline constexpr std::size_t order_packet_bytes = 1 + (1 + 8) + (1 + 9) + 2 * (3 + 25 * 5);
using OrderPacket = std::array<char, order_packet_bytes>;

/// Uses only fixmap, fixstr, array16 and float32 of MessagePack: another encoding of the same
/// numbers has made LoLA crash (nao_lola 1.1.1, changelog).
[[nodiscard]] OrderPacket order_packet(const LolaOrder& order);

}  // namespace gazed::lola
