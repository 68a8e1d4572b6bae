// Eight samples at a time: the vocabulary in which the kernels of this folder are written.
//
// - I16x8: eight samples of 16 bits. Arithmetic wraps, and is the same for signed and unsigned
//   samples unless a name says otherwise.
// - I32x4: four sums of 32 bits.
// - U8x16: sixteen bytes, as the camera delivers them.
//
// There are two sets of these types with the same names and the same results: gazed::ssse3, where
// each operation is one instruction of a 2008-class Atom (SSE2 and SSSE3), and gazed::plain, C++
// for any other processor. A kernel is written once, and lanes_test compares the two operation by
// operation.
//
// The choice is made when the library is compiled: SSSE3 if the target has it, unless
// GAZED_PLAIN_LANES is defined (option GAZED_SIMD in CMake). Nothing checks the processor at run
// time.
#pragma once

#include <cstdint>

#include "agent/saliency/lanes_plain.hpp"

#if defined(__SSSE3__) && !defined(GAZED_PLAIN_LANES)
#include "agent/saliency/lanes_ssse3.hpp"
#endif

namespace gazed::saliency {

#if defined(__SSSE3__) && !defined(GAZED_PLAIN_LANES)
namespace lanes = ssse3;
inline constexpr bool has_simd_lanes = true;
#else
namespace lanes = plain;
inline constexpr bool has_simd_lanes = false;
#endif

/// Lanes a, b, a, b, ...
[[nodiscard]] inline lanes::I16x8 alternating(std::int16_t a, std::int16_t b) {
  return interleaved_low(lanes::splat(a), lanes::splat(b));
}

/// The filter [1 4 6 4 1] of five neighbours: a gain of 16. a + 4b + 6c + 4d + e as
/// 2 (2 (b + d + c) + c) + a + e: of sums that wrap, only the total need fit.
template <typename V>
[[nodiscard]] V filtered(V a, V b, V c, V d, V e) {
  const V inner = b + d + c;
  const V half = inner + inner + c;
  return half + half + a + e;
}

/// Samples of 16 bits in one I16x8.
inline constexpr int lane_count = 8;

/// The length of a row of `samples` in whole I16x8.
[[nodiscard]] constexpr int padded_to_lanes(int samples) {
  return (samples + lane_count - 1) / lane_count * lane_count;
}

}  // namespace gazed::saliency
