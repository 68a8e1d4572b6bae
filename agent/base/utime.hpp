// Times: microseconds since the Unix epoch, as LCM's conventions have them.
#pragma once

#include <cstdint>

namespace gazed::base {

/// Times that a clock can show: what lies outside would overflow the differences taken of it.
[[nodiscard]] constexpr bool plausible_utime(std::int64_t utime_us) {
  return utime_us >= 0 && utime_us < (std::int64_t{1} << 62);
}

[[nodiscard]] constexpr double seconds_between(std::int64_t from_us, std::int64_t to_us) {
  return 1e-6 * (static_cast<double>(to_us) - static_cast<double>(from_us));
}

}  // namespace gazed::base
