#include "agent/lab/io/csv.hpp"

#include <utility>

namespace gazed::lab::io {

namespace {

/// Takes the quoted field at the front of `rest`, opening quote included; false when it is not
/// closed.
bool take_quoted(std::string_view& rest, std::string& field) {
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] != '"') {
      field += rest[i];
    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
      field += '"';
      ++i;
    } else {
      rest.remove_prefix(i + 1);
      return true;
    }
  }
  return false;
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::optional<std::vector<std::string>> split_csv_line(std::string_view line) {
  std::vector<std::string> fields;
  std::string_view rest = line;
  while (true) {
    std::string field;
    if (rest.starts_with('"')) {
      if (!take_quoted(rest, field)) return std::nullopt;
    } else {
      field = rest.substr(0, rest.find(','));
      rest.remove_prefix(field.size());
    }
    fields.push_back(std::move(field));
    if (rest.empty()) return fields;
    if (rest.front() != ',') return std::nullopt;
    rest.remove_prefix(1);
  }
}

ParsedNumber parsed_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (end != last || error == std::errc::invalid_argument) return {};
  if (error == std::errc::result_out_of_range) return {.value = {}, .out_of_range = true};
  return {.value = value};
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace gazed::lab::io
