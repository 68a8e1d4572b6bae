// The connection to LoLA's socket.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/base/file_descriptor.hpp"
#include "drivers/lola/order_packet.hpp"
#include "drivers/lola/packet_stream.hpp"
#include "drivers/lola/state_packet.hpp"

namespace gazed::lola {

/// A Unix stream socket. Connects 0.1 s after the first attempt is due: another program may have
/// just disconnected, and LoLA may then send an invalid packet (B-Human 2024, Main.cpp). After a
/// loss it reconnects after 0.1 s, then 0.2 s, 0.4 s, up to every 1 s, until a valid packet comes.
/// Times are those of a monotonic clock. No call blocks.
class LolaLink {
 public:
  /// Throws std::invalid_argument if the path is too long for a socket.
  explicit LolaLink(std::string path);

  /// -1 while not connected.
  [[nodiscard]] int descriptor() const { return socket_.get(); }
  [[nodiscard]] bool connected() const { return descriptor() >= 0; }

  /// Connects if it is time to. Returns true if it has just connected.
  bool connect_when_due(std::int64_t now_us);
  /// The next complete packet; none if there is no more or the connection was lost. Valid until the
  /// next call.
  [[nodiscard]] std::optional<StatePacket> receive(std::int64_t now_us);
  /// Reports that the last packet was valid.
  void approve();
  /// Sends an order. If LoLA does not accept it, the connection is lost. Does nothing while
  /// disconnected.
  void send(const OrderPacket& packet, std::int64_t now_us);
  /// Closes the connection for a reason.
  void lose(const std::string& why, std::int64_t now_us);

  /// Why there is no connection, until a valid packet comes; empty if all is well.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// Number of successful connections so far.
  [[nodiscard]] std::int64_t connections() const { return connections_; }

 private:
  [[nodiscard]] std::string silence() const;

  static constexpr std::int64_t first_back_off_us = 100'000;
  static constexpr std::int64_t longest_back_off_us = 1'000'000;

  std::string path_;
  base::FileDescriptor socket_{-1};
  PacketStream stream_;
  std::int64_t last_received_us_ = 0;
  std::optional<std::int64_t> next_attempt_us_;
  std::int64_t back_off_us_ = first_back_off_us;
  std::int64_t connections_ = 0;
  std::string fault_;
};

}  // namespace gazed::lola
