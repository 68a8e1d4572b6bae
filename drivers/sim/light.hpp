// The light that reaches a pixel, in grey levels: 0 is black, 255 is white at exposure 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gazed::sim {

/// Q10.5. A step is far below a camera's noise; what is brighter than 1023 levels, the peaks of a
/// contrasty tile under a gradient, is white at every exposure from 1/4 on. Whole numbers, because
/// every pixel of every simulated frame goes through them, on emulated CPUs too, where a
/// floating-point operation costs ten of theirs.
using Light = std::int16_t;

constexpr int light_fraction_bits = 5;

/// Rounded and held between -1024 and 1023.97.
[[nodiscard]] inline Light light_of(double grey_levels) {
  constexpr double most = INT16_MAX, least = INT16_MIN;
  return static_cast<Light>(
      std::lround(std::clamp(grey_levels * (1 << light_fraction_bits), least, most)));
}

/// The same for a sum in Q10.(5 + extra_bits).
[[nodiscard]] inline Light rounded_light(std::int64_t sum, int extra_bits) {
  const std::int64_t rounded = (sum + ((std::int64_t{1} << extra_bits) >> 1)) >> extra_bits;
  return static_cast<Light>(std::clamp<std::int64_t>(rounded, INT16_MIN, INT16_MAX));
}

[[nodiscard]] inline float levels_of(Light light) {
  return static_cast<float>(light) / (1 << light_fraction_bits);
}

}  // namespace gazed::sim
