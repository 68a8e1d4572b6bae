#include "drivers/log/event.hpp"

#include "drivers/lcm/big_endian.hpp"

namespace gazed::log {

LogEventHeader decode(std::span<const std::uint8_t, log_header_bytes> bytes) {
  return {.sync_word = lcm::read_big_endian<std::uint32_t>(bytes),
          .number = lcm::read_big_endian<std::int64_t>(bytes.subspan(4)),
          .time_us = lcm::read_big_endian<std::int64_t>(bytes.subspan(12)),
          .channel_bytes = lcm::read_big_endian<std::int32_t>(bytes.subspan(20)),
          .message_bytes = lcm::read_big_endian<std::int32_t>(bytes.subspan(24))};
}

LogHeaderBytes encode(const LogEventHeader& header) {
  LogHeaderBytes bytes{};
  const std::span<std::uint8_t> all(bytes);
  lcm::write_big_endian(header.sync_word, all);
  lcm::write_big_endian(header.number, all.subspan(4));
  lcm::write_big_endian(header.time_us, all.subspan(12));
  lcm::write_big_endian(header.channel_bytes, all.subspan(20));
  lcm::write_big_endian(header.message_bytes, all.subspan(24));
  return bytes;
}

}  // namespace gazed::log
