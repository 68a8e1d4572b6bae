#include "drivers/naoqi/wire.hpp"

#include <algorithm>
#include <utility>

namespace gazed {

namespace {

constexpr std::uint32_t magic = 0x42adde42;
constexpr std::size_t least_room = 64U << 10;

}  // namespace

QiBytes QiReader::take(std::size_t bytes) {
  ok_ = ok_ && bytes <= rest_.size();
  if (!ok_) return {};
  const QiBytes taken = rest_.first(bytes);
  rest_ = rest_.subspan(bytes);
  return taken;
}

std::uint64_t QiReader::integer(std::size_t bytes) {
  std::uint64_t value = 0;
  int shift = 0;
  for (const std::uint8_t byte : take(bytes)) {
    value |= std::uint64_t{byte} << shift;
    shift += 8;
  }
  return value;
}

std::string_view QiReader::text() {
  const QiBytes bytes = take(u32());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

QiWriter& QiWriter::integer(std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i)
    bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  return *this;
}

QiWriter& QiWriter::text(std::string_view text) {
  return u32(static_cast<std::uint32_t>(text.size()))
      .raw({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

QiWriter& QiWriter::raw(QiBytes bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return *this;
}

QiWriter& QiWriter::header(const QiHeader& header) {
  constexpr std::uint64_t version = 0;
  u32(magic).u32(header.id).u32(header.payload_bytes).integer(version, 2);
  integer(static_cast<std::uint8_t>(header.type), 1).integer(header.flags, 1);
  return u32(header.service).u32(header.object).u32(header.action);
}

std::optional<QiHeader> read_header(QiBytes bytes) {
  QiReader reader(bytes);
  const bool has_magic = reader.u32() == magic;
  QiHeader header;
  header.id = reader.u32();
  header.payload_bytes = reader.u32();
  reader.take(2);  // the version, 0 in all that are known
  header.type = static_cast<QiType>(reader.integer(1));
  header.flags = static_cast<std::uint8_t>(reader.integer(1));
  header.service = reader.u32();
  header.object = reader.u32();
  header.action = reader.u32();
  if (!reader.ok() || !has_magic || header.payload_bytes > qi_payload_max) return std::nullopt;
  return header;
}

std::optional<QiHeader> QiInbox::header() {
  if (broken_ || end_ - begin_ < qi_header_bytes) return std::nullopt;
  const auto header = read_header(QiBytes(buffer_).subspan(begin_, qi_header_bytes));
  broken_ = !header;
  return header;
}

std::span<std::uint8_t> QiInbox::room() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= std::exchange(begin_, 0);
  const auto begun = header();
  const std::size_t whole = qi_header_bytes + (begun ? begun->payload_bytes : 0);
  buffer_.resize(std::max({buffer_.size(), least_room, whole}));
  return std::span(buffer_).subspan(end_);
}

bool QiInbox::has_message() {
  const auto begun = header();
  return begun && end_ - begin_ - qi_header_bytes >= begun->payload_bytes;
}

std::optional<QiMessage> QiInbox::next() {
  if (!has_message()) return std::nullopt;
  const QiHeader begun = *header();
  const QiBytes payload = QiBytes(buffer_).subspan(begin_ + qi_header_bytes, begun.payload_bytes);
  begin_ += qi_header_bytes + begun.payload_bytes;
  return QiMessage{begun, payload};
}

}  // namespace gazed
