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

/// Every packet of every V6 (B-Human 2024, NaoProvider.h; HULKs; rUNSWift).
inline constexpr std::size_t state_packet_bytes = 896;
using StatePacket = std::span<const char, state_packet_bytes>;

/// Keys in any order; those that are not needed may hold anything that has no containers in it.
/// Nothing is allocated once it is made.
class StatePacketParser {
 public:
  StatePacketParser();
  ~StatePacketParser();
  StatePacketParser(const StatePacketParser&) = delete;
  StatePacketParser& operator=(const StatePacketParser&) = delete;

  /// None when it is not one map of these bytes, or when one of the arrays needed is missing, there
  /// twice, of another length, or holds another type. The numbers may be anything, NaN included.
  [[nodiscard]] std::optional<LolaState> parse(StatePacket packet);
  /// What the last packet that was none had instead: its size, a type, a length; in words.
  [[nodiscard]] std::string problem() const;

 private:
  class Visitor;
  class Parser;
  std::unique_ptr<Parser> parser_;
  // Of the last packet.
  bool ended_ = false;      // its map did
  std::size_t unread_ = 0;  // bytes behind that
  unsigned char first_byte_ = 0;
};

}  // namespace gazed::lola
