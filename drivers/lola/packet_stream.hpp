// Splits a stream of bytes, which arrives in any pieces, into packets.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "drivers/lola/state_packet.hpp"

namespace gazed::lola {

/// Where to put the bytes of the incoming packet.
class PacketStream {
 public:
  /// Space for the rest of the packet; after a complete packet, for all of the next one.
  [[nodiscard]] std::span<char> room() {
    if (complete()) filled_ = 0;
    return std::span(packet_).subspan(filled_);
  }
  /// Reports that this many bytes of room() have been written.
  void received(std::size_t bytes) { filled_ += bytes; }
  [[nodiscard]] bool complete() const { return filled_ == packet_.size(); }
  /// Number of bytes of an incomplete packet.
  [[nodiscard]] std::size_t partial() const { return complete() ? 0 : filled_; }
  /// Valid until room() is called.
  [[nodiscard]] StatePacket packet() const { return packet_; }
  /// Starts again at the beginning of a packet.
  void restart() { filled_ = 0; }

 private:
  std::array<char, state_packet_bytes> packet_{};
  std::size_t filled_ = 0;
};

}  // namespace gazed::lola
