// Texts that toml++ 3.3 must not be given: it has undefined behaviour on them.
//
// Letters outside ASCII where it looks for white space, outside strings and comments and in
// multi-line strings, reach a place that it marks as unreachable. Thousands of dotted names nest
// as many tables, which it frees by recursion until the stack ends.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gazed::base {

struct TomlHazard {
  int line = 0;  // from 1
  std::string what;
};

/// The first such place, or none.
[[nodiscard]] std::optional<TomlHazard> toml_hazard(std::string_view text);

}  // namespace gazed::base
