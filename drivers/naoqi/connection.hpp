// Messages to and from one address, over a TCP socket that never blocks.
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

/// An image of 1280x960 with two bytes a pixel takes 2.5 MB; more is refused.
inline constexpr std::uint32_t qi_payload_max = 4U << 20;

struct QiMessage {
  QiHeader header;
  QiBytes payload;  // borrowed
};

class QiConnection {
 public:
  /// Begins to connect. `wake_up` is told what to wait for; it must outlive the connection.
  QiConnection(WakeUp& wake_up, const base::Endpoint& to);
  /// Over a socket that is connected, and does not block.
  QiConnection(WakeUp& wake_up, base::FileDescriptor socket);

  /// At once where the socket takes it, else by the next receive(), and in order.
  void send(QiHeader header, QiBytes payload);
  /// The next message, if all of it has come; its payload is valid until the next call. What
  /// follows it stays in the socket.
  [[nodiscard]] std::optional<QiMessage> receive();
  /// Something waits in the socket.
  [[nodiscard]] bool has_more() const;
  /// Something has come, be it a part of a message, since this was asked last or it was opened.
  [[nodiscard]] bool heard() { return std::exchange(heard_, false); }
  /// Why the connection is of no use any more; empty as long as it is.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  ssize_t checked(ssize_t result);
  void flush();
  [[nodiscard]] std::string_view why_closed() const;
  bool fill(std::size_t bytes);

  WakeUp& wake_up_;
  base::FileDescriptor socket_;
  std::string outbox_, inbox_;
  std::size_t filled_ = 0;  // of the inbox, with the message that comes
  bool heard_ = true;
  bool robot_spoke_ = false;  // ever
  std::string problem_;
};

}  // namespace gazed::naoqi
