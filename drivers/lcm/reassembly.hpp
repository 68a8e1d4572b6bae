// Puts fragments together to messages, whatever they claim.
//
// Anybody in the network can send fragments. So a message is begun by its first fragment only,
// which names the channel and with it how large a message can be; a source (address and port) has
// one message in the making, as every sender of LCM does; there are few sources; and what is not
// completed in time makes place. All of them together have at most as much memory as two of the
// largest messages that are read: one in the making, and one of somebody else.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/lcm/datagram.hpp"

namespace gazed::lcm {

/// Who sent a datagram; as numbers, in whatever order of bytes.
struct DatagramSource {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  bool operator==(const DatagramSource&) const = default;
};

class Reassembly {
 public:
  using Clock = std::chrono::steady_clock;
  /// Messages that are in the making at once; one more takes the place of the oldest.
  static constexpr std::size_t sources_max = 4;
  /// The memory of all of them, in messages of the largest size that is read.
  static constexpr std::size_t messages_held_max = 2;
  /// A message that was begun longer ago is given up: at 100 Mbit/s the largest frame takes 0.1 s.
  static constexpr std::chrono::milliseconds patience{1000};

  /// Adds a fragment. When it completes a message, the message, valid until the next call.
  /// `message_bytes_max` is the limit of the fragment's channel (0: nobody wants it); it counts for
  /// first fragments, which alone name one.
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> add(const DatagramSource& source,
                                                                 const Fragment& fragment,
                                                                 std::size_t message_bytes_max,
                                                                 Clock::time_point now);

  /// The channel of the message that add() has completed.
  [[nodiscard]] std::string_view channel() const { return completed_channel_; }
  /// Bytes that are held for messages in the making.
  [[nodiscard]] std::size_t held_bytes() const;

 private:
  struct Part {
    bool open = false;
    DatagramSource source;
    std::uint32_t sequence = 0;
    std::uint16_t count = 0;
    std::uint32_t bytes_left = 0;
    std::size_t fragments_left = 0;
    Clock::time_point begun{};
    std::array<char, channel_bytes_max> channel{};
    std::size_t channel_bytes = 0;
    std::vector<std::uint8_t> message;
    std::bitset<65536> seen;  // by fragment number
  };

  Part* begin(const DatagramSource& source, const Fragment& fragment, Clock::time_point now);
  void make_room(const Part& part, std::size_t message_bytes);
  Part* part_of(const DatagramSource& source);

  std::array<Part, sources_max> parts_;
  std::size_t message_bytes_max_ = 0;  // of all channels so far
  std::string_view completed_channel_;
};

}  // namespace gazed::lcm
