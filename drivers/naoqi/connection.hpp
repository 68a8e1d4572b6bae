// Messages to and from one address, over a TCP socket that never blocks.
#pragma once

#include <span>
#include <string>
#include <sys/types.h>

#include "agent/endpoint.hpp"
#include "agent/file_descriptor.hpp"
#include "drivers/naoqi/message.hpp"
#include "drivers/naoqi/wake_up.hpp"

namespace gazed {

/// An image of 1280x960 with two bytes a pixel takes 2.5 MB; more is refused.
inline constexpr std::uint32_t qi_payload_max = 4U << 20;

struct QiMessage {
  QiHeader header;
  QiBytes payload;  // borrowed
};

/// One message after the other out of a stream of bytes.
class QiInbox {
 public:
  /// Where the next bytes go: up to the end of a header or of its payload, never farther.
  [[nodiscard]] std::span<char> room();
  /// So many have come: the message that they complete. Its payload is valid until the next call.
  [[nodiscard]] std::optional<QiMessage> received(std::size_t bytes);
  /// What came is no qi message, or too large; nothing that follows can be understood.
  [[nodiscard]] bool broken() const;

 private:
  QiHeader header_;
  std::string payload_;
  std::size_t filled_ = 0;  // of both
};

class QiConnection {
 public:
  /// Begins to connect. `wake_up` is told what to wait for; it must outlive the connection.
  QiConnection(WakeUp& wake_up, const Endpoint& to, std::int64_t now_us);

  /// At once where the socket takes it, else by the next receive(), and in order.
  void send(QiHeader header, QiBytes payload);
  /// The next message; its payload is valid until the next call. None when no more has come.
  [[nodiscard]] std::optional<QiMessage> receive(std::int64_t now_us);
  /// There is something in the socket that receive() has not come to.
  [[nodiscard]] bool has_more() const;
  /// When anything came last, be it a part of a message.
  [[nodiscard]] std::int64_t heard_us() const { return heard_us_; }
  /// Why the connection is of no use any more; empty as long as it is.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  ssize_t checked(ssize_t result);
  void flush();

  WakeUp& wake_up_;
  FileDescriptor socket_;
  QiInbox inbox_;
  QiWriter outbox_;
  std::int64_t heard_us_;
  std::string problem_;
};

}  // namespace gazed
