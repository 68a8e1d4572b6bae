// The packet that tells LoLA's joints where to go: {Position, Stiffness}, 276 bytes.
#pragma once

#include <array>
#include <cstddef>

#include "drivers/lola/body.hpp"

namespace gazed::lola {

/// A map of two; for each a key of 8 and 9 letters and 25 numbers.
inline constexpr std::size_t order_packet_bytes = 1 + (1 + 8) + (1 + 9) + 2 * (3 + 25 * 5);
using OrderPacket = std::array<char, order_packet_bytes>;

/// MessagePack as fixmap, fixstr, array16 and float32 and nothing else: another encoding of the
/// same numbers has made LoLA crash (nao_lola 1.1.1, changelog).
[[nodiscard]] OrderPacket order_packet(const LolaOrder& order);

}  // namespace gazed::lola
