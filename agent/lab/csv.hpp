// Comma-separated values, RFC 4180: fields that hold a comma or a quote stand in quotes, a quote
// inside is doubled. A field does not span lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gazed {

/// `text` as one field, in quotes where it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

/// The fields of one line without its line end; at least one. None when a quote is not closed or
/// something follows a closing quote.
[[nodiscard]] std::optional<std::vector<std::string>> split_csv_line(std::string_view line);

}  // namespace gazed
