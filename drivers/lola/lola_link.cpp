#include "drivers/lola/lola_link.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/un.h>
#include <utility>

#include "agent/base/text.hpp"

namespace gazed::lola {

namespace {

// LoLA sends every 12 ms. If it stops, it may have dropped us (rUNSWift 2022, LoLAEffector.cpp:
// "ignores us until we disconnect").
constexpr std::int64_t silent_us = 1'000'000;

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  return address;
}

std::string problem_of(int error) {
  // ECONNRESET: the peer closed with unread data.
  if (error == ECONNRESET || error == EPIPE) return "LoLA has closed the connection";
  std::string problem = std::strerror(error);
  if (error == ENOENT) problem += ": is this a V6, with a file /home/nao/robocup.conf?";
  if (error == ECONNREFUSED) problem += ": nobody listens there";
  if (error == EAGAIN) problem = "LoLA does not answer: has another program the socket?";
  return problem;
}

}  // namespace

LolaLink::LolaLink(std::string path) : path_(std::move(path)) {
  constexpr std::size_t longest = sizeof(sockaddr_un::sun_path) - 1;
  if (path_.empty() || path_.size() > longest)
    throw std::invalid_argument("lola: the path of a socket has 1 to " + std::to_string(longest) +
                                " bytes, " + base::excerpt(path_) + " has " +
                                std::to_string(path_.size()));
}

bool LolaLink::connect_when_due(std::int64_t now_us) {
  if (!next_attempt_us_) next_attempt_us_ = now_us + first_back_off_us;
  if (connected() || now_us < *next_attempt_us_) return false;
  base::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const sockaddr_un address = address_of(path_);
  if (socket.get() < 0 ||
      ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    lose(problem_of(errno), now_us);
    return false;
  }
  socket_ = std::move(socket);
  stream_.restart();
  last_received_us_ = now_us;
  ++connections_;
  return true;
}

std::optional<StatePacket> LolaLink::receive(std::int64_t now_us) {
  while (connected()) {
    const std::span<char> room = stream_.room();
    const ssize_t received = ::recv(descriptor(), room.data(), room.size(), 0);
    if (received > 0) {
      last_received_us_ = now_us;
      stream_.received(static_cast<std::size_t>(received));
      if (stream_.complete()) return stream_.packet();
    } else if (received == 0) {
      lose(problem_of(EPIPE), now_us);
    } else if (errno == EAGAIN) {
      if (now_us - last_received_us_ >= silent_us) lose(silence(), now_us);
      return std::nullopt;
    } else if (errno != EINTR) {
      lose(problem_of(errno), now_us);
    }
  }
  return std::nullopt;
}

std::string LolaLink::silence() const {
  const std::string words = "LoLA says nothing for 1 s";
  if (stream_.partial() == 0) return words;
  return words + base::text(" after %zu bytes of a packet, LoLA's have %zu", stream_.partial(),
                            state_packet_bytes);
}

void LolaLink::approve() {
  back_off_us_ = first_back_off_us;
  fault_.clear();
}

void LolaLink::send(const OrderPacket& packet, std::int64_t now_us) {
  if (!connected()) return;
  ssize_t sent = 0;
  do {
    sent = ::send(descriptor(), packet.data(), packet.size(), MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  if (sent == static_cast<ssize_t>(packet.size())) return;
  // A full buffer means that LoLA has not read for seconds. It must not carry out the waiting
  // orders one by one later, when we believe that the head is somewhere else.
  const bool full = sent >= 0 || errno == EAGAIN;
  lose(full ? "LoLA takes no orders" : problem_of(errno), now_us);
}

void LolaLink::lose(const std::string& why, std::int64_t now_us) {
  socket_ = base::FileDescriptor(-1);
  fault_ = path_ + ": " + why;
  next_attempt_us_ = now_us + back_off_us_;
  back_off_us_ = std::min(2 * back_off_us_, longest_back_off_us);
}

}  // namespace gazed::lola
