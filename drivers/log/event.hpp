// The format of an LCM event log, as lcm-logger writes it: events one after the other, each
//
//   sync word 0xEDA1DA01, event number (int64), time of arrival in microseconds (int64), bytes of
//   the channel's name (int32), bytes of the message (int32), name, message; most significant byte
//   first.
//
// Source: LCM 1.3.1, lcm/eventlog.c. Its own reader ends at the first event whose sizes cannot be,
// and allocates what a damaged size says, so gazed reads and writes the format itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gazed::log {

constexpr std::uint32_t log_sync_word = 0xEDA1DA01U;
constexpr std::size_t log_header_bytes = 28;
constexpr std::size_t longest_channel_name = 63;  // lcm/udpm_util.h, LCM_MAX_CHANNEL_NAME_LENGTH

struct LogEventHeader {
  std::uint32_t sync_word = log_sync_word;
  std::int64_t number = 0;
  std::int64_t time_us = 0;
  std::int32_t channel_bytes = 0;
  std::int32_t message_bytes = 0;
};

/// What a log keeps of a message.
struct Event {
  std::string_view channel;
  std::int64_t utime_us = 0;
  std::span<const std::uint8_t> message;
};

using LogHeaderBytes = std::array<std::uint8_t, log_header_bytes>;

[[nodiscard]] LogEventHeader decode(std::span<const std::uint8_t, log_header_bytes> bytes);
[[nodiscard]] LogHeaderBytes encode(const LogEventHeader& header);

}  // namespace gazed::log
