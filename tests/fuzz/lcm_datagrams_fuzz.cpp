// Any datagrams, from up to four senders, taken as LCM's: parsed and put together to messages. Two
// bytes before each say how long it is, and who sends it.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <variant>

#include "drivers/lcm/datagram.hpp"
#include "drivers/lcm/reassembly.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed::lcm;
  constexpr std::size_t limit = 4096;
  Reassembly reassembly;
  Reassembly::Clock::time_point now{std::chrono::seconds(1000)};
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() > 2) {
    const DatagramSource source{rest[1] & 3U, 1};
    now += std::chrono::milliseconds(rest[1] >> 2);
    const std::size_t bytes = std::min<std::size_t>(rest[0], rest.size() - 2);
    const auto packet = rest.subspan(2, bytes);
    rest = rest.subspan(2 + bytes);
    const Datagram read = parse_datagram(packet);
    if (const auto* message = std::get_if<ShortMessage>(&read)) {
      if (message->channel.empty() || message->channel.size() > channel_bytes_max) std::abort();
      if (message->channel.size() + message->data.size() + 9 != bytes) std::abort();
    } else if (const auto* fragment = std::get_if<Fragment>(&read)) {
      const auto done = reassembly.add(source, *fragment, limit, now);
      if (done && (done->empty() || done->size() > limit)) std::abort();
      if (done && reassembly.channel().empty()) std::abort();
    }
  }
  if (reassembly.held_bytes() > 2 * Reassembly::sources_max * limit) std::abort();
  return 0;
}
