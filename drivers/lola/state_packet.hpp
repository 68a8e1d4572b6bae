// LoLA's state packet: a MessagePack map of 896 bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/lola/body.hpp"

namespace gazed::lola {

/// The same for every V6 (B-Human 2024, NaoProvider.h; HULKs; rUNSWift).
inline constexpr std::size_t state_packet_bytes = 896;
using StatePacket = std::span<const char, state_packet_bytes>;

/// Accepts keys in any order. Keys that are not needed may have any value without containers.
/// Allocates only at construction.
class StatePacketParser {
 public:
  StatePacketParser();
  ~StatePacketParser();
  StatePacketParser(const StatePacketParser&) = delete;
  StatePacketParser& operator=(const StatePacketParser&) = delete;

  /// None if the packet is not exactly one map of these bytes, or if a required array is missing,
  /// duplicated, or has the wrong length or type. The numbers may be anything, including NaN.
  [[nodiscard]] std::optional<LolaState> parse(StatePacket packet);
  /// What was wrong with the last refused packet (size, type or length), in words.
  [[nodiscard]] std::string problem() const;

 private:
  class Visitor;
  class Parser;
  std::unique_ptr<Parser> parser_;
  // For the last packet.
  bool ended_ = false;      // its map was complete
  std::size_t unread_ = 0;  // bytes after the map
  unsigned char first_byte_ = 0;
};

}  // namespace gazed::lola
