// Linear interpolation in whole numbers.
#pragma once

#include <cstdint>

namespace gazed::sim {

constexpr int share_bits = 12;

/// From a to b, by a share in Q0.12, rounded down. a and b of up to 18 bits: the product has 31.
[[nodiscard]] inline std::int32_t between(std::int32_t a, std::int32_t b, std::int32_t share) {
  return a + (((b - a) * share) >> share_bits);
}

}  // namespace gazed::sim
