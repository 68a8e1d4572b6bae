#include "drivers/naoqi/value.hpp"

namespace gazed {

namespace {

// What a robot sends is nested 4 deep, and its longest list, the methods of ALMotion, has some
// thousand values. Without limits a message of 4 MB could be the work of minutes.
constexpr int deepest = 16;
constexpr int values_max = 65536;
constexpr std::size_t longest_dynamic_signature = 256;

std::optional<std::size_t> fixed_bytes(char type) {
  constexpr std::string_view by_size[] = {"v", "bcC", "wW", "", "iIf", "", "", "", "lLd"};
  for (std::size_t bytes = 0; bytes < std::size(by_size); ++bytes)
    if (by_size[bytes].find(type) != std::string_view::npos) return bytes;
  return std::nullopt;
}

/// The end of the bracket that `signature` begins with; 0 when it has none.
std::size_t bracket_end(std::string_view signature) {
  int open = 0;
  for (std::size_t i = 0; i < signature.size(); ++i) {
    if (std::string_view("([{<").find(signature[i]) != std::string_view::npos) ++open;
    if (std::string_view(")]}>").find(signature[i]) != std::string_view::npos) --open;
    if (open <= 0) return open == 0 ? i + 1 : 0;
  }
  return 0;
}

/// The first type, without the names that follow it; empty when there is none.
std::string_view take_type(std::string_view& signature) {
  const std::string_view type = signature.substr(0, bracket_end(signature));
  signature.remove_prefix(type.size());
  if (signature.starts_with('<')) {
    const std::size_t names = bracket_end(signature);
    signature.remove_prefix(names == 0 ? signature.size() : names);
  }
  return type;
}

std::string_view inside(std::string_view bracket) {
  return bracket.substr(1, bracket.size() - 2);
}

bool skip_types(QiReader& reader, std::string_view types, int depth, int& values_left);

bool skip_type(QiReader& reader, std::string_view type, int depth, int& values_left) {
  if (type.empty() || depth > deepest || --values_left < 0) return false;
  if (const auto bytes = fixed_bytes(type[0])) return reader.take(*bytes), reader.ok();
  switch (type[0]) {
    case 's':
    case 'r':
      return reader.text(), reader.ok();
    case 'm': {
      std::string_view own = reader.text();
      if (own.size() > longest_dynamic_signature) return false;
      return skip_type(reader, take_type(own), depth + 1, values_left) && own.empty();
    }
    case '(':
      return type.back() == ')' && skip_types(reader, inside(type), depth + 1, values_left);
    case '[':
    case '{':
      if (type.back() != (type[0] == '[' ? ']' : '}')) return false;
      for (std::uint32_t count = reader.u32(); count > 0; --count) {
        const std::size_t before = reader.rest().size();
        if (!skip_types(reader, inside(type), depth + 1, values_left)) return false;
        if (reader.rest().size() == before)
          return false;  // empty values: there could be any number
      }
      return reader.ok();
    default:  // objects among them, which nobody asks for
      return false;
  }
}

bool skip_types(QiReader& reader, std::string_view types, int depth, int& values_left) {
  while (!types.empty())
    if (!skip_type(reader, take_type(types), depth, values_left)) return false;
  return true;
}

}  // namespace

std::optional<QiValue> take_value(QiReader& reader, std::string_view& signature) {
  QiValue value{take_type(signature), reader.rest()};
  int values_left = values_max;
  if (!skip_type(reader, value.signature, 0, values_left)) return std::nullopt;
  value.bytes = value.bytes.first(value.bytes.size() - reader.rest().size());
  while (value.signature == "m") {
    QiReader dynamic(value.bytes);
    std::string_view own = dynamic.text();
    value = {take_type(own), dynamic.rest()};
  }
  return value;
}

std::optional<double> QiValue::number() const {
  if (signature.size() != 1 || signature == "v") return std::nullopt;
  const auto size = fixed_bytes(signature[0]);
  if (!size || bytes.size() != *size) return std::nullopt;
  const std::uint64_t bits = QiReader(bytes).integer(*size);
  const auto shift = 64 - 8 * static_cast<int>(*size);
  switch (signature[0]) {
    case 'f':
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case 'd':
      return std::bit_cast<double>(bits);
    case 'c':
    case 'w':
    case 'i':
    case 'l':
      return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
    default:
      return static_cast<double>(bits);
  }
}

std::optional<std::string_view> QiValue::text() const {
  if (signature != "s" && signature != "r") return std::nullopt;
  return QiReader(bytes).text();
}

std::size_t QiValue::elements(std::span<QiValue> into) const {
  if (signature.size() < 2) return 0;
  QiReader reader(bytes);
  std::size_t found = 0;
  for (std::uint32_t count = signature[0] == '(' ? 1 : reader.u32(); count > 0; --count) {
    for (std::string_view types = inside(signature); !types.empty();) {
      const auto value = found < into.size() ? take_value(reader, types) : std::nullopt;
      if (!value) return found;
      into[found++] = *value;
    }
  }
  return found;
}

}  // namespace gazed
