// The computer's two clocks, replaceable in tests.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

namespace gazed::drivers {

struct Clocks {
  std::function<std::int64_t()> monotonic_us;  // CLOCK_MONOTONIC, never goes back
  std::function<std::int64_t()> realtime_us;   // since the Unix epoch; may be set at any time
};

[[nodiscard]] inline Clocks computers_clocks() {
  const auto now_of = [](auto clock) {
    return std::chrono::duration_cast<std::chrono::microseconds>(clock.now().time_since_epoch())
        .count();
  };
  return {[now_of] { return now_of(std::chrono::steady_clock()); },
          [now_of] { return now_of(std::chrono::system_clock()); }};
}

}  // namespace gazed::drivers
