// Messages of qi, NAOqi's protocol: a header of 28 bytes, then the payload, which is a sequence of
// values; all little-endian (libqi, src/messaging/message.hpp; QiLoop, doc/about-qimessaging.md).
//
// A value's type is given by its signature: b bool; c C w W i I l L integers of 1, 1, 2, 2, 4, 4,
// 8, 8 bytes; f d reals; s text; r bytes; v nothing; [T] a list, {KV} a map, (T..) a tuple,
// optionally followed by names in <>; m a dynamic value, which carries its own signature.
// names in <> may follow; m a dynamic value, which brings its own signature.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gazed::naoqi {

using QiBytes = std::string_view;

enum class QiType : std::uint8_t { call = 1, reply = 2, error = 3, capability = 6 };

/// Has the layout of the wire format: all of gazed's targets are little-endian, too.
struct QiHeader {
  std::uint32_t magic = 0x42adde42;
  std::uint32_t id = 0;
  std::uint32_t payload_bytes = 0;
  std::uint16_t version = 0;
  QiType type = QiType::call;
  std::uint8_t flags = 0;
  std::uint32_t service = 0, object = 0, action = 0;
};
static_assert(sizeof(QiHeader) == 28 && std::endian::native == std::endian::little);
// flag: the payload is "m", whatever type is expected
inline constexpr std::uint8_t qi_dynamic_payload = 1;

/// Builds a payload.
class QiWriter {
 public:
  [[nodiscard]] QiBytes bytes() const { return bytes_; }

  QiWriter& raw(QiBytes bytes) {
    bytes_ += bytes;
    return *this;
  }
  QiWriter& integer(std::uint64_t value, std::size_t bytes) {
    return raw({reinterpret_cast<const char*>(&value), bytes});
  }
  QiWriter& u32(std::uint32_t value) { return integer(value, 4); }
  QiWriter& f32(float value) { return u32(std::bit_cast<std::uint32_t>(value)); }
  /// Types "s" and "r": a u32 with the number of bytes, then the bytes.
  QiWriter& text(std::string_view text) {
    return u32(static_cast<std::uint32_t>(text.size())).raw(text);
  }
  /// Type "m".
  QiWriter& dynamic(std::string_view value) { return text("s").text(value); }
  QiWriter& dynamic(float value) { return text("f").f32(value); }
  /// A list as the official client sends it: each element is dynamic, too.
  template <typename Range>
  QiWriter& dynamic_list(const Range& values) {
    text("[m]").u32(static_cast<std::uint32_t>(std::size(values)));
    for (const auto& value : values) dynamic(value);
    return *this;
  }

 private:
  std::string bytes_;
};

class QiReader;

/// A value inside its message. Never "m": a dynamic value is replaced by its content.
struct QiValue {
  std::string_view signature;  // empty when there is no value
  QiBytes bytes;

  explicit operator bool() const { return !signature.empty(); }
  /// For integers, reals and bools.
  [[nodiscard]] std::optional<double> number() const;
  /// For text or bytes.
  [[nodiscard]] std::optional<std::string_view> text() const;
  /// The elements of a list or tuple; the alternating keys and values of a map; otherwise empty.
  [[nodiscard]] QiReader elements() const;
  /// No value if the index is past the last.
  [[nodiscard]] QiValue element(std::size_t index) const;
};

/// Decodes a payload from its beginning.
class QiReader {
 public:
  /// next() returns values of `types`, one after the other; the whole sequence is repeated `times`.
  explicit QiReader(QiBytes bytes = {}, std::string_view types = {}, std::uint32_t times = 1)
      : rest_(bytes), types_(types), times_(times) {}

  /// No value after the last one, and from the first error on: an invalid signature, the end of the
  /// message, nesting deeper than 16, a type of more than 256 characters, or more than 65536 values
  /// in the message.
  QiValue next();

  // For callers that know what comes next: only the end of the message is checked. Past it
  // everything is 0 or empty.
  QiBytes take(std::size_t bytes) {
    ok_ = ok_ && bytes <= rest_.size();
    const QiBytes taken = rest_.substr(0, ok_ ? bytes : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::uint64_t integer(std::size_t bytes) {
    std::uint64_t value = 0;
    take(bytes).copy(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  }
  std::uint32_t u32() { return static_cast<std::uint32_t>(integer(4)); }
  std::string_view text() { return take(u32()); }
  [[nodiscard]] QiBytes rest() const { return rest_; }

 private:
  /// Skips one value. Returns false if there is none.
  bool skip(std::string_view type, int depth);

  QiBytes rest_;
  std::string_view types_, due_;
  std::uint32_t times_;
  int values_left_ = 65536;
  bool ok_ = true;
};

}  // namespace gazed::naoqi
