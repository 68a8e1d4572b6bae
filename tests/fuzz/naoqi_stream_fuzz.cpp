// Any bytes from NAOqi's socket in any pieces, put together to messages: a piece is some bytes,
// once or many times, so that short inputs reach messages for which the inbox has to grow.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "drivers/naoqi/connection.hpp"

namespace {

/// Returns how many bytes the messages had that were whole then.
std::size_t receive(gazed::QiInbox& inbox, gazed::QiBytes piece) {
  std::size_t returned = 0;
  while (!piece.empty() && !inbox.broken()) {
    const auto room = inbox.room();
    if (room.empty()) std::abort();
    const std::size_t bytes = std::min(room.size(), piece.size());
    std::copy_n(piece.begin(), bytes, room.begin());
    piece.remove_prefix(bytes);
    if (const auto message = inbox.received(bytes)) {
      if (message->payload.size() != message->header.payload_bytes) std::abort();
      if (message->payload.size() > gazed::qi_payload_max) std::abort();
      returned += sizeof message->header + message->payload.size();
    }
  }
  return returned;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t enough_bytes = 100'000;
  static std::string piece;
  gazed::QiInbox inbox;
  std::size_t received = 0, returned = 0;
  gazed::QiBytes rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty() && !inbox.broken()) {
    // Before it comes a byte: 6 bits are its length, 2 say that it comes 1, 8, 64 or 512 times,
    // until enough has come.
    const auto first = static_cast<std::uint8_t>(rest.front());
    const std::size_t length = std::min<std::size_t>(first & 63U, rest.size() - 1);
    piece.clear();
    const unsigned often = received < enough_bytes ? 1U << 3 * (first >> 6) : 1;
    for (unsigned times = 0; times < often; ++times) piece += rest.substr(1, length);
    rest.remove_prefix(1 + length);
    received += piece.size();
    returned += receive(inbox, piece);
  }
  if (returned > received) std::abort();
  return 0;
}
