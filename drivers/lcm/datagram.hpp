// The UDP datagrams that LCM's messages travel in.
//
// Vocabulary. A short datagram holds a whole message; a longer message travels as fragments, of
// which the first names the channel. The format is LCM's "UDP Multicast Protocol Description", all
// numbers big endian:
//   short     "LC02", sequence u32, channel, NUL, data
//   fragment  "LC03", sequence u32, message size u32, offset u32, number u16, count u16,
//             in fragment 0 only: channel, NUL; data
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace gazed::lcm {

/// The longest name of a channel, bytes (lcm.h, LCM_MAX_CHANNEL_NAME_LENGTH).
inline constexpr std::size_t channel_bytes_max = 63;
/// What a UDP datagram over IPv4 can hold: 65535 less the headers of IP (20) and UDP (8).
inline constexpr std::size_t datagram_bytes_max = 65507;

/// A message in one piece. Borrows from the datagram.
struct ShortMessage {
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

/// A piece of a message. Borrows from the datagram.
struct Fragment {
  std::uint32_t sequence = 0;       // the same in all fragments of a message
  std::uint32_t message_bytes = 0;  // of the whole message
  std::uint32_t offset = 0;         // of `data` in the message
  std::uint16_t number = 0;         // below count
  std::uint16_t count = 0;          // at least 1
  std::string_view channel;         // in fragment 0 only
  std::span<const std::uint8_t> data;
};

/// Nothing for what is not LCM's, or contradicts itself: no end of the channel's name within the
/// datagram, a name that is empty or too long, a number that is not below the count, no data, data
/// that would end beyond the message.
using Datagram = std::variant<std::monostate, ShortMessage, Fragment>;
[[nodiscard]] Datagram parse_datagram(std::span<const std::uint8_t> bytes);

/// Cuts messages into datagrams as liblcm does, so that every reader of LCM takes them.
class DatagramWriter {
 public:
  /// Begins a message. False when no datagrams can carry it: a channel name that is empty or too
  /// long, or more fragments than LCM can number. `message` must outlive the calls of next().
  bool begin(std::string_view channel, std::span<const std::uint8_t> message);

  /// The next datagram of the message, valid until the next call; empty after the last.
  [[nodiscard]] std::span<const std::uint8_t> next();

 private:
  void put_channel();
  void put_data(std::size_t bytes);

  std::vector<std::uint8_t> datagram_;  // grows to one datagram, once
  std::string_view channel_;
  std::span<const std::uint8_t> message_;
  std::uint32_t sequence_ = 0;
  std::size_t sent_bytes_ = 0;
  std::size_t number_ = 0;
  std::size_t count_ = 0;  // of datagrams
};

}  // namespace gazed::lcm
