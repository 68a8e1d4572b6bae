#include "drivers/naoqi/connection.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace gazed {

namespace {

/// "Not yet" is not an error.
bool would_block(int error) {
  return error == EAGAIN || error == EINTR || error == EINPROGRESS;
}

}  // namespace

void QiConnection::open(const Endpoint& to) {
  close();
  socket_ = FileDescriptor(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (socket_.get() < 0) {
    problem_ = std::strerror(errno);
    return;
  }
  const int on = 1;  // a command of some bytes is not to wait for more of them
  setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  address.sin_addr.s_addr = htonl(to.address);
  if (connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
      !would_block(errno))
    problem_ = std::strerror(errno);
  wake_up_.watch(socket_.get(), true);
}

void QiConnection::close() {
  socket_ = FileDescriptor(-1);
  inbox_.clear();
  outbox_.clear();
  sent_ = 0;
  problem_.clear();
}

void QiConnection::send(const QiHeader& header, QiBytes payload) {
  QiHeader complete = header;
  complete.payload_bytes = static_cast<std::uint32_t>(payload.size());
  outbox_.header(complete).raw(payload);
  flush();
}

void QiConnection::flush() {
  const QiBytes rest = outbox_.bytes().subspan(sent_);
  if (rest.empty() || !problem().empty()) return;
  const ssize_t count = ::send(socket_.get(), rest.data(), rest.size(), MSG_NOSIGNAL);
  if (count >= 0) {
    sent_ += static_cast<std::size_t>(count);
  } else if (!would_block(errno)) {
    problem_ = std::strerror(errno);
  }
  if (sent_ == outbox_.bytes().size()) {
    outbox_.clear();
    sent_ = 0;
  }
  wake_up_.watch(socket_.get(), !outbox_.bytes().empty());
}

bool QiConnection::receive() {
  bool came = false;
  while (problem().empty() && !inbox_.has_message()) {
    const auto room = inbox_.room();
    const ssize_t count = recv(socket_.get(), room.data(), room.size(), 0);
    if (count < 0) {
      if (!would_block(errno)) problem_ = std::strerror(errno);
      break;
    }
    if (count == 0) problem_ = "the robot closed the connection";
    inbox_.received(static_cast<std::size_t>(count));
    came = true;
  }
  return came;
}

bool QiConnection::exchange() {
  flush();
  return receive();
}

bool QiConnection::has_more() const {
  int bytes = 0;
  return ioctl(socket_.get(), FIONREAD, &bytes) == 0 && bytes > 0;
}

std::string QiConnection::problem() const {
  return inbox_.broken() ? "what it sends is no qi messaging" : problem_;
}

}  // namespace gazed
