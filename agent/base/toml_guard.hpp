// What is found in a TOML text without parsing it: what toml++ must not be given, and strings
// without an end.
//
// toml++ 3.3 has undefined behaviour on some texts. Letters outside ASCII where it looks for white
// space, outside strings and comments and in multi-line strings, reach a place that it marks as
// unreachable. Thousands of dotted names nest as many tables, which it frees by recursion until the
// stack ends.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "agent/base/source_text.hpp"

namespace gazed::base {

struct TomlHazard : TextPlace {
  std::string what;
};

/// The first text that toml++ must not be given, or none.
[[nodiscard]] std::optional<TomlHazard> toml_hazard(std::string_view text);

struct UnclosedString {
  TextPlace begin;  // its quote
  bool is_multi_line = false;
};

/// Where strings begin that nothing ends, in the order of the text.
[[nodiscard]] std::vector<UnclosedString> unclosed_strings(std::string_view text);

/// What is open where a text ends.
struct TomlEnd {
  std::optional<TextPlace> header;  // the last one, "[camera]"
  std::string closers;              // of arrays and inline tables, the innermost first: "}]"
  TextPlace opener;                 // of the innermost
  TextPlace item;                   // what is behind it, or behind its last comma
  std::size_t item_offset = 0;
};
[[nodiscard]] TomlEnd end_of(std::string_view text);

}  // namespace gazed::base
