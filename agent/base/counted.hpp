// Numbers of things in messages for people.
#pragma once

#include <cstdint>
#include <string>

namespace gazed::base {

/// "1 event", "3 events".
[[nodiscard]] inline std::string counted(std::int64_t number, const std::string& noun) {
  return std::to_string(number) + ' ' + noun + (number == 1 ? "" : "s");
}

}  // namespace gazed::base
