#include "drivers/naoqi/connection.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace gazed {

std::span<char> QiInbox::room() {
  const auto header = std::span(reinterpret_cast<char*>(&header_), sizeof header_);
  if (filled_ < header.size()) return header.subspan(filled_);
  return std::span(payload_).subspan(filled_ - header.size());
}

std::optional<QiMessage> QiInbox::received(std::size_t bytes) {
  filled_ += bytes;
  if (filled_ < sizeof header_ || broken()) return std::nullopt;
  payload_.resize(header_.payload_bytes);
  if (filled_ < sizeof header_ + payload_.size()) return std::nullopt;
  filled_ = 0;
  return QiMessage{header_, payload_};
}

bool QiInbox::broken() const {
  const bool known = header_.magic == QiHeader().magic && header_.payload_bytes <= qi_payload_max;
  return filled_ >= sizeof header_ && !known;
}

QiConnection::QiConnection(WakeUp& wake_up, const Endpoint& to, std::int64_t now_us)
    : wake_up_(wake_up),
      socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
      heard_us_(now_us) {
  checked(socket_.get());
  const int on = 1;  // a command of some bytes is not to wait for more of them
  setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  address.sin_addr.s_addr = htonl(to.address);
  checked(connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address));
  wake_up_.watch(socket_.get(), true);
}

/// What a system call returned. The first error is the problem, and "not yet" is none.
ssize_t QiConnection::checked(ssize_t result) {
  const bool not_yet = errno == EAGAIN || errno == EINTR || errno == EINPROGRESS;
  if (result < 0 && !not_yet && problem_.empty()) problem_ = std::strerror(errno);
  return result;
}

void QiConnection::send(QiHeader header, QiBytes payload) {
  header.payload_bytes = static_cast<std::uint32_t>(payload.size());
  outbox_.header(header).raw(payload);
  flush();
}

void QiConnection::flush() {
  const QiBytes waiting = outbox_.bytes();
  if (waiting.empty() || !problem_.empty()) return;
  const ssize_t count =
      checked(::send(socket_.get(), waiting.data(), waiting.size(), MSG_NOSIGNAL));
  if (count > 0) outbox_.erase_front(static_cast<std::size_t>(count));
  wake_up_.watch(socket_.get(), !outbox_.bytes().empty());
}

std::optional<QiMessage> QiConnection::receive(std::int64_t now_us) {
  flush();
  while (problem_.empty()) {
    const auto room = inbox_.room();
    const ssize_t count = checked(recv(socket_.get(), room.data(), room.size(), 0));
    if (count < 0) break;
    if (count == 0) problem_ = "the robot closed the connection";
    heard_us_ = now_us;
    if (const auto message = inbox_.received(static_cast<std::size_t>(count))) return message;
    if (inbox_.broken()) problem_ = "what it sends is no qi messaging";
  }
  return std::nullopt;
}

bool QiConnection::has_more() const {
  char next = 0;
  return recv(socket_.get(), &next, sizeof next, MSG_PEEK) > 0;
}

}  // namespace gazed
