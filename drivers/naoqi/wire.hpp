// qi messaging on the wire: a header of 28 bytes, then the payload; everything little-endian
// (libqi, src/messaging/message.hpp; QiLoop, doc/about-qimessaging.md).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace gazed {

using QiBytes = std::span<const std::uint8_t>;

enum class QiType : std::uint8_t { call = 1, reply = 2, error = 3, capability = 6 };

struct QiHeader {
  std::uint32_t id = 0;
  std::uint32_t payload_bytes = 0;
  QiType type = QiType::call;
  std::uint8_t flags = 0;
  std::uint32_t service = 0, object = 0, action = 0;
};
inline constexpr std::size_t qi_header_bytes = 28;
inline constexpr std::uint8_t qi_dynamic_payload = 1;  // flag: the payload is "m", whatever is due
/// An image of 1280x960 with two bytes a pixel takes 2.5 MB; more is refused.
inline constexpr std::uint32_t qi_payload_max = 4U << 20;

struct QiMessage {
  QiHeader header;
  QiBytes payload;  // borrowed
};

/// Takes a message apart. Reading past its end gives zeros, and ok() is false from then on.
class QiReader {
 public:
  explicit QiReader(QiBytes bytes) : rest_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] QiBytes rest() const { return rest_; }
  QiBytes take(std::size_t bytes);
  std::uint64_t integer(std::size_t bytes);
  std::uint32_t u32() { return static_cast<std::uint32_t>(integer(4)); }
  /// A u32 that counts bytes, and these: types "s" and "r".
  std::string_view text();

 private:
  QiBytes rest_;
  bool ok_ = true;
};

/// Puts a message together.
class QiWriter {
 public:
  [[nodiscard]] QiBytes bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }
  QiWriter& integer(std::uint64_t value, std::size_t bytes);
  QiWriter& u32(std::uint32_t value) { return integer(value, 4); }
  QiWriter& f32(float value) { return u32(std::bit_cast<std::uint32_t>(value)); }
  QiWriter& text(std::string_view text);
  QiWriter& raw(QiBytes bytes);
  QiWriter& header(const QiHeader& header);

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Nothing when it is none, or announces more than qi_payload_max.
[[nodiscard]] std::optional<QiHeader> read_header(QiBytes bytes);

/// Messages out of a stream of bytes.
class QiInbox {
 public:
  /// Where the next bytes go. What next() returned before is overwritten.
  [[nodiscard]] std::span<std::uint8_t> room();
  void received(std::size_t bytes) { end_ += bytes; }
  [[nodiscard]] bool has_message();
  [[nodiscard]] std::optional<QiMessage> next();
  /// What came is no qi message; nothing that follows can be understood.
  [[nodiscard]] bool broken() const { return broken_; }
  void clear() { begin_ = end_ = 0, broken_ = false; }

 private:
  [[nodiscard]] std::optional<QiHeader> header();

  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  bool broken_ = false;
};

}  // namespace gazed
