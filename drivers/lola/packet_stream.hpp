// Packets out of a stream of bytes that comes in any pieces.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "drivers/lola/state_packet.hpp"

namespace gazed::lola {

/// Where the bytes of the packet that is coming go.
class PacketStream {
 public:
  /// Room for what is still missing of the packet; all of the next one after a complete one.
  [[nodiscard]] std::span<char> room() {
    if (complete()) filled_ = 0;
    return std::span(packet_).subspan(filled_);
  }
  /// This many bytes of room() have been written.
  void received(std::size_t bytes) { filled_ += bytes; }
  [[nodiscard]] bool complete() const { return filled_ == packet_.size(); }
  /// Bytes of a packet that is not complete.
  [[nodiscard]] std::size_t partial() const { return complete() ? 0 : filled_; }
  /// Valid until room() is called.
  [[nodiscard]] StatePacket packet() const { return packet_; }
  /// The stream begins anew.
  void restart() { filled_ = 0; }

 private:
  std::array<char, state_packet_bytes> packet_{};
  std::size_t filled_ = 0;
};

}  // namespace gazed::lola
