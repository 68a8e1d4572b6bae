#include "drivers/naoqi/message.hpp"

namespace gazed::naoqi {

namespace {

// Robots nest values 6 deep, and the longest list, the methods of ALMotion, has some thousand
// values. Without these limits (and values_left_), decoding a malicious message of 4 MB could take
// minutes.
constexpr int deepest = 16;
constexpr std::size_t longest_type = 256;

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

std::optional<std::size_t> fixed_bytes(char type) {
  constexpr std::string_view by_size[] = {"v", "bcC", "wW", "", "iIf", "", "", "", "lLd"};
  for (std::size_t bytes = 0; bytes < std::size(by_size); ++bytes)
    if (is_one_of(by_size[bytes], type)) return bytes;
  return std::nullopt;
}

/// The end of the bracket at the beginning of `signature`; 0 if it is not closed.
std::size_t bracket_end(std::string_view signature) {
  int open = 0;
  for (std::size_t i = 0; i < signature.size(); ++i) {
    if (is_one_of("([{<", signature[i])) ++open;
    if (is_one_of(")]}>", signature[i])) --open;
    if (open <= 0) return open == 0 ? i + 1 : 0;
  }
  return 0;
}

/// The first type, without the names that may follow it; empty if there is none.
std::string_view take_type(std::string_view& signature) {
  const std::string_view type = signature.substr(0, bracket_end(signature));
  signature.remove_prefix(type.size());
  if (signature.starts_with('<')) signature.remove_prefix(bracket_end(signature));
  return type;
}

std::string_view inside(std::string_view bracket) {
  return bracket.substr(1, bracket.size() - 2);
}

}  // namespace

bool QiReader::skip(std::string_view type, int depth) {
  if (type.empty() || type.size() > longest_type) return false;
  if (depth > deepest || --values_left_ < 0) return false;
  if (const auto bytes = fixed_bytes(type[0])) return take(*bytes), ok_;
  if (type == "s" || type == "r") return text(), ok_;
  if (type == "m") {
    std::string_view own = text();
    return skip(take_type(own), depth + 1) && own.empty();
  }
  const bool is_tuple = type.starts_with('(') && type.ends_with(')');
  const bool is_list = type.starts_with('[') && type.ends_with(']');
  const bool is_map = type.starts_with('{') && type.ends_with('}');
  if (!is_tuple && !is_list && !is_map) return false;  // an object; gazed never asks for one
  for (std::uint32_t count = is_tuple ? 1 : u32(); count > 0; --count) {
    const std::size_t before = rest_.size();
    for (std::string_view types = inside(type); !types.empty();)
      if (!skip(take_type(types), depth + 1)) return false;
    // empty elements: there could be any number of them
    if (!is_tuple && rest_.size() == before) return false;
  }
  return ok_;
}

QiValue QiReader::next() {
  if (due_.empty() && times_ > 0) {
    due_ = types_;
    --times_;
  }
  QiValue value{take_type(due_), rest_};
  ok_ = skip(value.signature, 0);
  if (!ok_) return {};
  value.bytes.remove_suffix(rest_.size());
  if (value.signature != "m") return value;
  QiReader dynamic(value.bytes);
  const std::string_view own = dynamic.text();
  return QiReader(dynamic.rest(), own).next();
}

std::optional<double> QiValue::number() const {
  const auto size = signature.size() == 1 ? fixed_bytes(signature[0]) : std::nullopt;
  if (!size || *size == 0) return std::nullopt;
  const std::uint64_t bits = QiReader(bytes).integer(*size);
  if (signature == "f") return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  if (signature == "d") return std::bit_cast<double>(bits);
  if (!is_one_of("cwil", signature[0])) return static_cast<double>(bits);
  const auto shift = 64 - 8 * static_cast<int>(*size);  // shift left and back, to extend the sign
  return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
}

std::optional<std::string_view> QiValue::text() const {
  if (signature != "s" && signature != "r") return std::nullopt;
  return QiReader(bytes).text();
}

QiReader QiValue::elements() const {
  if (signature.size() < 2) return QiReader();
  QiReader reader(bytes);
  const std::uint32_t times = signature[0] == '(' ? 1 : reader.u32();
  return QiReader(reader.rest(), inside(signature), times);
}

QiValue QiValue::element(std::size_t index) const {
  QiReader reader = elements();
  for (; index > 0; --index) reader.next();
  return reader.next();
}

}  // namespace gazed::naoqi
