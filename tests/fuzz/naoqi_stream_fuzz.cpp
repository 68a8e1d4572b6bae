// Any bytes from NAOqi's socket in any pieces, put together to messages: a piece is some bytes,
// once or many times, so that short inputs reach messages that come in many parts.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <sys/socket.h>

#include "drivers/naoqi/connection.hpp"

namespace {

/// Returns how many bytes the messages had that were whole then.
std::size_t receive(gazed::naoqi::QiConnection& connection) {
  std::size_t returned = 0;
  while (const auto message = connection.receive()) {
    if (message->payload.size() != message->header.payload_bytes) std::abort();
    if (message->payload.size() > gazed::naoqi::qi_payload_max) std::abort();
    returned += sizeof message->header + message->payload.size();
  }
  if (connection.problem().empty() && connection.has_more()) std::abort();
  return returned;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t enough_bytes = 100'000;
  static gazed::naoqi::WakeUp wake_up;
  static std::string piece;
  std::array<int, 2> ends{-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()) != 0) std::abort();
  const gazed::base::FileDescriptor robot(ends[0]);
  gazed::naoqi::QiConnection connection(wake_up, gazed::base::FileDescriptor(ends[1]));
  std::size_t sent = 0, returned = 0;
  gazed::naoqi::QiBytes rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty() && connection.problem().empty()) {
    // Before it comes a byte: 6 bits are its length, 2 say that it comes 1, 8, 64 or 512 times,
    // until enough has come.
    const auto first = static_cast<std::uint8_t>(rest.front());
    const std::size_t length = std::min<std::size_t>(first & 63U, rest.size() - 1);
    piece.clear();
    const unsigned often = sent < enough_bytes ? 1U << 3 * (first >> 6) : 1;
    for (unsigned times = 0; times < often; ++times) piece += rest.substr(1, length);
    rest.remove_prefix(1 + length);
    // A socket's room is larger than the largest piece.
    const ssize_t count = send(robot.get(), piece.data(), piece.size(), MSG_NOSIGNAL);
    if (count != static_cast<ssize_t>(piece.size())) std::abort();
    sent += piece.size();
    returned += receive(connection);
  }
  if (returned > sent) std::abort();
  return 0;
}
