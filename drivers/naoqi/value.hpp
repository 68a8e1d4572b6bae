// Values of qi messaging. What type one has says its signature: b bool; c C w W i I l L integers of
// 1, 1, 2, 2, 4, 4, 8, 8 bytes; f d reals; s text; r bytes; v nothing; [T] a list, {KV} a map,
// (T..) a tuple, which names in <> may follow; m a dynamic value, which brings its own signature.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "drivers/naoqi/wire.hpp"

namespace gazed {

/// A value where it lies in its message. Never "m": of a dynamic one, what is in it.
struct QiValue {
  std::string_view signature;
  QiBytes bytes;

  /// Of any integer, real or bool.
  [[nodiscard]] std::optional<double> number() const;
  /// Of text or bytes.
  [[nodiscard]] std::optional<std::string_view> text() const;
  /// Of a list or a tuple its elements, of a map keys and values in turn: as many as fit into
  /// `into`. Returns how many.
  std::size_t elements(std::span<QiValue> into) const;
};

/// The next value, of the first type in `signature`, which moves on to the next type. Nothing when
/// there is none such: wrong signature, end of the message, nested deeper than 16, over 65536
/// values in it.
[[nodiscard]] std::optional<QiValue> take_value(QiReader& reader, std::string_view& signature);

inline void write_dynamic(QiWriter& writer, std::string_view value) {
  writer.text("s").text(value);
}
inline void write_dynamic(QiWriter& writer, float value) {
  writer.text("f").f32(value);
}
/// As the official client sends a list: each element dynamic, too.
template <typename Range>
void write_dynamic_list(QiWriter& writer, const Range& values) {
  writer.text("[m]").u32(static_cast<std::uint32_t>(std::size(values)));
  for (const auto& value : values) write_dynamic(writer, value);
}

}  // namespace gazed
