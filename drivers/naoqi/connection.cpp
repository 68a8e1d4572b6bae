#include "drivers/naoqi/connection.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace gazed::naoqi {

QiConnection::QiConnection(WakeUp& wake_up, base::FileDescriptor socket)
    : wake_up_(wake_up), socket_(std::move(socket)) {
  checked(socket_.get());
  wake_up_.watch(socket_.get(), true);
}

QiConnection::QiConnection(WakeUp& wake_up, const base::Endpoint& to)
    : QiConnection(wake_up, base::FileDescriptor(
                                socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0))) {
  const int on = 1;  // small commands must not wait for more data to fill a packet
  setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  address.sin_addr.s_addr = htonl(to.address);
  checked(connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address));
}

/// The result of a system call. The first error becomes the problem, except "try again".
ssize_t QiConnection::checked(ssize_t result) {
  const bool not_yet = errno == EAGAIN || errno == EINTR || errno == EINPROGRESS;
  // The peer closed the connection without reading everything we had sent.
  const bool closed = errno == ECONNRESET || errno == EPIPE;
  if (result < 0 && !not_yet && problem_.empty())
    problem_ = closed ? std::string(why_closed()) : std::strerror(errno);
  return result;
}

void QiConnection::send(QiHeader header, QiBytes payload) {
  header.payload_bytes = static_cast<std::uint32_t>(payload.size());
  outbox_.append(reinterpret_cast<const char*>(&header), sizeof header).append(payload);
  flush();
}

void QiConnection::flush() {
  if (outbox_.empty() || !problem_.empty()) return;
  const ssize_t sent = checked(::send(socket_.get(), outbox_.data(), outbox_.size(), MSG_NOSIGNAL));
  if (sent > 0) outbox_.erase(0, static_cast<std::size_t>(sent));
  wake_up_.watch(socket_.get(), !outbox_.empty());
}

std::optional<QiMessage> QiConnection::receive() {
  flush();
  QiHeader header;
  if (!fill(sizeof header)) return std::nullopt;
  std::memcpy(&header, inbox_.data(), sizeof header);
  if (header.magic != QiHeader().magic || header.payload_bytes > qi_payload_max)
    problem_ = "what it sends is no qi messaging";
  if (!fill(sizeof header + header.payload_bytes)) return std::nullopt;
  filled_ = 0;
  return QiMessage{header, QiBytes(inbox_).substr(sizeof header, header.payload_bytes)};
}

/// Receives what is missing of a message's first `bytes`, and nothing beyond. Returns true once all
/// are there without an error.
bool QiConnection::fill(std::size_t bytes) {
  while (filled_ < bytes && problem_.empty()) {
    // Grows as bytes arrive: announcing 4 MB costs the sender nothing, so it must not cost us
    // memory.
    const std::size_t end = std::min(bytes, filled_ + (64U << 10));
    inbox_.resize(std::max(inbox_.size(), end));
    const ssize_t count = checked(recv(socket_.get(), inbox_.data() + filled_, end - filled_, 0));
    if (count < 0) return false;
    if (count == 0) problem_ = why_closed();
    filled_ += static_cast<std::size_t>(count);
    heard_ = true;
    robot_spoke_ = robot_spoke_ || count > 0;
  }
  return filled_ >= bytes && problem_.empty();
}

/// A port that only accepts TLS closes at the first byte that is not TLS, mostly after sending an
/// alert (RFC 5246: content type 21, major version 3).
std::string_view QiConnection::why_closed() const {
  const bool alert = filled_ >= 2 && inbox_[0] == 21 && inbox_[1] == 3;
  if (!alert && robot_spoke_) return "the robot closed the connection";
  return "the robot closed the connection; if the port is for tcps (TLS), which is not supported, "
         "a tcp port is needed";
}

bool QiConnection::has_more() const {
  char next = 0;
  return recv(socket_.get(), &next, sizeof next, MSG_PEEK) > 0;
}

}  // namespace gazed::naoqi
