// Any bytes from NAOqi's socket in any pieces, put together to messages.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/naoqi/wire.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static gazed::QiInbox inbox;  // its room is kept, as in the driver
  inbox.clear();
  std::size_t received = 0, returned = 0;
  gazed::QiBytes rest(data, size);
  while (!rest.empty() && !inbox.broken()) {
    gazed::QiBytes piece = rest.subspan(1).first(
        std::min<std::size_t>(rest.front(), rest.size() - 1));  // its length comes before it
    rest = rest.subspan(1 + piece.size());
    while (!piece.empty() && !inbox.broken()) {
      const auto room = inbox.room();
      if (room.empty()) std::abort();
      const std::size_t bytes = std::min(room.size(), piece.size());
      std::copy_n(piece.begin(), bytes, room.begin());
      inbox.received(bytes);
      received += bytes;
      piece = piece.subspan(bytes);
      while (const auto message = inbox.next()) {
        returned += gazed::qi_header_bytes + message->payload.size();
        if (message->payload.size() != message->header.payload_bytes) std::abort();
      }
    }
  }
  if (returned > received) std::abort();
  return 0;
}
