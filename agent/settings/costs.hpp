// What a key costs when it is turned up or down: time, bytes, certainty. For --print-config and
// --help KEY.
#pragma once

#include <span>
#include <string_view>

namespace gazed::settings {

struct Cost {
  std::string_view path;  // of the key
  std::string_view text;  // a clause with its numbers
};

[[nodiscard]] std::span<const Cost> all_costs();

/// Empty for a key whose value costs nothing, or whose cost nobody has measured.
[[nodiscard]] std::string_view cost_of(std::string_view path);

}  // namespace gazed::settings
