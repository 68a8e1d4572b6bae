#include "drivers/lcm/datagram.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "drivers/lcm/big_endian.hpp"

namespace gazed::lcm {

namespace {

constexpr std::uint32_t short_magic = 0x4C433032;     // "LC02"
constexpr std::uint32_t fragment_magic = 0x4C433033;  // "LC03"
constexpr std::size_t short_header_bytes = 8;
constexpr std::size_t fragment_header_bytes = 20;
constexpr std::size_t fragment_payload_bytes = datagram_bytes_max - fragment_header_bytes;
// The greatest message that fits a short datagram, with its channel's name: liblcm leaves the NUL
// out of the sum (lcm_udpm.c, LCM_SHORT_MESSAGE_MAX_SIZE = 65499), and so keeps one byte free.
constexpr std::size_t short_payload_bytes = datagram_bytes_max - short_header_bytes;

/// The name before the NUL, which is taken as well.
std::optional<std::string_view> read_channel(BigEndianReader& reader) {
  const auto rest = reader.rest();
  const auto longest = rest.first(std::min(rest.size(), channel_bytes_max + 1));
  const auto end = std::ranges::find(longest, std::uint8_t{0});
  if (end == longest.end() || end == longest.begin()) return std::nullopt;
  const auto bytes = static_cast<std::size_t>(end - longest.begin());
  static_cast<void>(reader.take(static_cast<std::int64_t>(bytes) + 1));
  return std::string_view(reinterpret_cast<const char*>(rest.data()), bytes);
}

Datagram parse_short(BigEndianReader reader) {
  const auto channel = read_channel(reader);
  if (!channel) return {};
  return ShortMessage{*channel, reader.rest()};
}

Datagram parse_fragment(std::uint32_t sequence, BigEndianReader reader) {
  const auto message_bytes = reader.integer<std::uint32_t>();
  const auto offset = reader.integer<std::uint32_t>();
  const auto number = reader.integer<std::uint16_t>();
  const auto count = reader.integer<std::uint16_t>();
  if (!count || *number >= *count) return {};
  Fragment out{.sequence = sequence,
               .message_bytes = *message_bytes,
               .offset = *offset,
               .number = *number,
               .count = *count,
               .channel = {},
               .data = {}};
  if (out.number == 0) {
    const auto channel = read_channel(reader);
    if (!channel) return {};
    out.channel = *channel;
  }
  out.data = reader.rest();
  const bool fits = std::uint64_t{out.offset} + out.data.size() <= out.message_bytes;
  if (out.data.empty() || !fits) return {};
  return out;
}

}  // namespace

Datagram parse_datagram(std::span<const std::uint8_t> bytes) {
  BigEndianReader reader(bytes);
  const auto magic = reader.integer<std::uint32_t>();
  const auto sequence = reader.integer<std::uint32_t>();
  if (!sequence) return {};
  if (*magic == short_magic) return parse_short(reader);
  if (*magic == fragment_magic) return parse_fragment(*sequence, reader);
  return {};
}

bool DatagramWriter::begin(std::string_view channel, std::span<const std::uint8_t> message) {
  count_ = 0;
  number_ = 0;
  sent_bytes_ = 0;
  if (channel.empty() || channel.size() > channel_bytes_max) return false;
  const std::size_t payload = channel.size() + 1 + message.size();
  const std::size_t count = payload <= short_payload_bytes
                                ? 1
                                : (payload + fragment_payload_bytes - 1) / fragment_payload_bytes;
  if (count > std::numeric_limits<std::uint16_t>::max()) return false;
  channel_ = channel;
  message_ = message;
  count_ = count;
  ++sequence_;
  datagram_.reserve(datagram_bytes_max);
  return true;
}

std::span<const std::uint8_t> DatagramWriter::next() {
  if (number_ == count_) return {};
  std::array<std::uint8_t, fragment_header_bytes> header{};
  const std::span all(header);
  write_big_endian(count_ == 1 ? short_magic : fragment_magic, all.first<4>());
  write_big_endian(sequence_, all.subspan<4, 4>());
  write_big_endian(static_cast<std::uint32_t>(message_.size()), all.subspan<8, 4>());
  write_big_endian(static_cast<std::uint32_t>(sent_bytes_), all.subspan<12, 4>());
  write_big_endian(static_cast<std::uint16_t>(number_), all.subspan<16, 2>());
  write_big_endian(static_cast<std::uint16_t>(count_), all.subspan<18, 2>());
  const auto used = all.first(count_ == 1 ? short_header_bytes : fragment_header_bytes);
  datagram_.assign(used.begin(), used.end());
  if (number_ == 0) put_channel();
  put_data(count_ == 1 ? message_.size() : datagram_bytes_max - datagram_.size());
  ++number_;
  return datagram_;
}

void DatagramWriter::put_channel() {
  datagram_.insert(datagram_.end(), channel_.begin(), channel_.end());
  datagram_.push_back(0);
}

void DatagramWriter::put_data(std::size_t bytes) {
  const auto data = message_.subspan(sent_bytes_, std::min(bytes, message_.size() - sent_bytes_));
  datagram_.insert(datagram_.end(), data.begin(), data.end());
  sent_bytes_ += data.size();
}

}  // namespace gazed::lcm
