// What a link asks of a connection, whatever carries it.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "drivers/lcm/subscriptions.hpp"

namespace gazed::lcm {

/// Connections hand what they receive to the Subscriptions that they were made with.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~Connection() = default;

  /// Readable when receive() has something to do.
  [[nodiscard]] virtual int descriptor() const = 0;
  /// Reads a channel from now on; false when that cannot be.
  [[nodiscard]] virtual bool read_channel(const Subscription& subscription) = 0;
  /// Hands over what has come, at most `most` datagrams or messages. False when the connection is
  /// lost and must be made anew.
  [[nodiscard]] virtual bool receive(int most, Clock::time_point now) = 0;
  /// False when the message could not be sent.
  [[nodiscard]] virtual bool send(const std::string& channel,
                                  std::span<const std::uint8_t> message) = 0;
  /// Packets that are no messages, so far.
  [[nodiscard]] virtual std::int64_t malformed_packets() const { return 0; }
};

}  // namespace gazed::lcm
