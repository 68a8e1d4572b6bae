// Messages to and from one address, over a TCP socket that never blocks.
#pragma once

#include <string>

#include "agent/endpoint.hpp"
#include "agent/file_descriptor.hpp"
#include "drivers/naoqi/wake_up.hpp"
#include "drivers/naoqi/wire.hpp"

namespace gazed {

class QiConnection {
 public:
  /// `wake_up` is told what to wait for; it must outlive the connection.
  explicit QiConnection(WakeUp& wake_up) : wake_up_(wake_up) {}

  /// Begins to connect; a connection there was is closed.
  void open(const Endpoint& to);
  void close();
  /// At once where the socket takes it, else by the next exchange(), and in order.
  void send(const QiHeader& header, QiBytes payload);
  /// Sends what waits, and receives until there is a message or nothing more to receive. True when
  /// something came.
  bool exchange();
  /// More has come than exchange() has taken.
  [[nodiscard]] bool has_more() const;
  /// A message received; its payload is valid until the next exchange().
  [[nodiscard]] std::optional<QiMessage> next() { return inbox_.next(); }
  /// Why the connection is of no use any more; empty as long as it is.
  [[nodiscard]] std::string problem() const;

 private:
  void flush();
  [[nodiscard]] bool receive();

  WakeUp& wake_up_;
  FileDescriptor socket_{-1};
  QiInbox inbox_;
  QiWriter outbox_;
  std::size_t sent_ = 0;  // of the outbox
  std::string problem_;
};

}  // namespace gazed
