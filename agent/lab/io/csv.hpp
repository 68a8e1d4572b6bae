// Comma-separated values, RFC 4180: fields that hold a comma or a quote stand in quotes, a quote
// inside is doubled. A field does not span lines.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace gazed::lab::io {

/// `text` as one field, in quotes where it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

/// The fields of one line without its line end; at least one. None when a quote is not closed or
/// something follows a closing quote.
[[nodiscard]] std::optional<std::vector<std::string>> split_csv_line(std::string_view line);

/// `text` without the blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The number that all of `text` is, "nan" and "inf" among them; none for anything else.
template <typename Number>
[[nodiscard]] std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

struct ParsedNumber {
  std::optional<double> value;
  bool out_of_range = false;  // a number, but nearer to 0 or farther from it than a double
};

/// As parsed<double>, a '+' in front allowed, as spreadsheets and printf write it.
[[nodiscard]] ParsedNumber parsed_number(std::string_view text);

}  // namespace gazed::lab::io
