// Exchanges messages with one address over a non-blocking TCP socket.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "agent/base/endpoint.hpp"
#include "agent/base/file_descriptor.hpp"
#include "drivers/naoqi/message.hpp"
#include "drivers/naoqi/wake_up.hpp"

namespace gazed::naoqi {

/// An image of 1280x960 with two bytes per pixel takes 2.5 MB; anything larger than this is
/// refused.
inline constexpr std::uint32_t qi_payload_max = 4U << 20;

struct QiMessage {
  QiHeader header;
  QiBytes payload;  // valid until the next receive()
};

class QiConnection {
 public:
  /// Starts to connect, and registers with `wake_up`, which must outlive the connection.
  QiConnection(WakeUp& wake_up, const base::Endpoint& to);
  /// Uses a socket that is already connected and non-blocking.
  QiConnection(WakeUp& wake_up, base::FileDescriptor socket);

  /// Sends at once if the socket accepts it, otherwise during later calls of receive(), in order.
  void send(QiHeader header, QiBytes payload);
  /// The next complete message, if there is one; its payload is valid until the next call. Whatever
  /// follows it stays in the socket.
  [[nodiscard]] std::optional<QiMessage> receive();
  /// True if unread data is waiting in the socket.
  [[nodiscard]] bool has_more() const;
  /// True if anything, even part of a message, has arrived since the last call.
  [[nodiscard]] bool heard() { return std::exchange(heard_, false); }
  /// Why the connection can no longer be used; empty while it can.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  ssize_t checked(ssize_t result);
  void flush();
  [[nodiscard]] std::string_view why_closed() const;
  bool fill(std::size_t bytes);

  WakeUp& wake_up_;
  base::FileDescriptor socket_;
  std::string outbox_, inbox_;
  std::size_t filled_ = 0;  // bytes in the inbox, including those of an incomplete message
  bool heard_ = true;
  bool robot_spoke_ = false;  // has ever sent anything
  std::string problem_;
};

}  // namespace gazed::naoqi
