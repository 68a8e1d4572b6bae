// Four floats at a time, with gcc's vector extension. Every operation is defined on single floats
// in the order of the source, so the bits are the same on every target.
#pragma once

#include <cstdint>
#include <cstring>

namespace gazed::tracking {

using Float4 [[gnu::vector_size(16)]] = float;

[[nodiscard]] inline Float4 splat4(float value) {
  return Float4{value, value, value, value};
}
[[nodiscard]] inline Float4 load4(const float* from) {
  Float4 out;
  std::memcpy(&out, from, sizeof(out));
  return out;
}
/// Reads eight samples and uses four.
[[nodiscard]] inline Float4 load4(const std::uint16_t* from) {
  using Short8 [[gnu::vector_size(16)]] = std::uint16_t;
  using Int4 [[gnu::vector_size(16)]] = std::int32_t;
  Short8 samples;
  std::memcpy(&samples, from, sizeof(samples));
  const Short8 widened = __builtin_shufflevector(samples, Short8{}, 0, 8, 1, 9, 2, 10, 3, 11);
  Int4 integers;
  std::memcpy(&integers, &widened, sizeof(integers));
  return __builtin_convertvector(integers, Float4);
}
inline void store4(float* to, Float4 value) {
  std::memcpy(to, &value, sizeof(value));
}
[[nodiscard]] inline float sum4(Float4 a) {
  return (a[0] + a[2]) + (a[1] + a[3]);
}

}  // namespace gazed::tracking
