// Numbers as LCM writes them, in messages and in logs: most significant byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

namespace gazed::lcm {

/// The integer in the first sizeof(Integer) of `bytes`, which must hold as many.
template <class Integer>
[[nodiscard]] Integer read_big_endian(std::span<const std::uint8_t> bytes) {
  std::make_unsigned_t<Integer> value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value = static_cast<decltype(value)>(value << 8 | bytes[i]);
  }
  return static_cast<Integer>(value);
}

template <class Integer>
void write_big_endian(Integer number, std::span<std::uint8_t> bytes) {
  auto value = static_cast<std::make_unsigned_t<Integer>>(number);
  for (std::size_t i = sizeof(Integer); i-- > 0; value >>= 8) {
    bytes[i] = static_cast<std::uint8_t>(value & 0xFF);
  }
}

/// Reads one thing after the other and never past the end.
class BigEndianReader {
 public:
  explicit BigEndianReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] std::span<const std::uint8_t> rest() const { return rest_; }

  template <class Integer>
  [[nodiscard]] std::optional<Integer> integer() {
    const auto bytes = take(sizeof(Integer));
    if (!bytes) return std::nullopt;
    return read_big_endian<Integer>(*bytes);
  }

  /// The next `count` bytes; none when `count` is negative or more than there are.
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> take(std::int64_t count) {
    if (count < 0 || static_cast<std::uint64_t>(count) > rest_.size()) return std::nullopt;
    const auto taken = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

}  // namespace gazed::lcm
