// The lanes of lanes.hpp in SSE2 and SSSE3: no instruction is younger than 2008.
#pragma once

#include <cstdint>
#include <tmmintrin.h>

namespace gazed::saliency::ssse3 {

struct I16x8 {
  __m128i bits;
};
struct I32x4 {
  __m128i bits;
};
struct U8x16 {
  __m128i bits;
};

// Memory. `load` and `store` want an address that is a multiple of 16.

inline I16x8 load(const std::int16_t* from) {
  return {_mm_load_si128(reinterpret_cast<const __m128i*>(from))};
}
inline I16x8 load_unaligned(const std::int16_t* from) {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))};
}
inline void store(std::int16_t* to, I16x8 a) {
  _mm_store_si128(reinterpret_cast<__m128i*>(to), a.bits);
}
inline I32x4 load(const std::int32_t* from) {
  return {_mm_load_si128(reinterpret_cast<const __m128i*>(from))};
}
inline void store(std::int32_t* to, I32x4 a) {
  _mm_store_si128(reinterpret_cast<__m128i*>(to), a.bits);
}
inline U8x16 load_unaligned(const std::uint8_t* from) {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))};
}
inline I16x8 load_half(const std::int16_t* from) {
  return {_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))};
}
inline U8x16 load_half(const std::uint8_t* from) {
  return {_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))};
}

// Sixteen bits.

inline I16x8 splat(std::int16_t value) {
  return {_mm_set1_epi16(value)};
}
inline I16x8 multiples(std::int16_t step) {
  return {_mm_mullo_epi16(_mm_set1_epi16(step), _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7))};
}
inline I16x8 operator+(I16x8 a, I16x8 b) {
  return {_mm_add_epi16(a.bits, b.bits)};
}
inline I16x8 operator-(I16x8 a, I16x8 b) {
  return {_mm_sub_epi16(a.bits, b.bits)};
}
inline I16x8 operator&(I16x8 a, I16x8 b) {
  return {_mm_and_si128(a.bits, b.bits)};
}
inline I16x8 without(I16x8 a, I16x8 mask) {
  return {_mm_andnot_si128(mask.bits, a.bits)};
}
template <int bits>
I16x8 shifted_left(I16x8 a) {
  return {_mm_slli_epi16(a.bits, bits)};
}
template <int bits>
I16x8 shifted_right(I16x8 a) {
  return {_mm_srai_epi16(a.bits, bits)};
}
template <int bits>
I16x8 shifted_right_unsigned(I16x8 a) {
  return {_mm_srli_epi16(a.bits, bits)};
}
inline I16x8 shifted_left_by(I16x8 a, int bits) {
  return {_mm_sll_epi16(a.bits, _mm_cvtsi32_si128(bits))};
}
inline I16x8 times_q15(I16x8 a, I16x8 b) {
  return {_mm_mulhrs_epi16(a.bits, b.bits)};
}
inline I16x8 smaller(I16x8 a, I16x8 b) {
  return {_mm_min_epi16(a.bits, b.bits)};
}
inline I16x8 larger(I16x8 a, I16x8 b) {
  return {_mm_max_epi16(a.bits, b.bits)};
}
inline I16x8 magnitude(I16x8 a) {
  return {_mm_abs_epi16(a.bits)};
}
inline I16x8 is_greater(I16x8 a, I16x8 b) {
  return {_mm_cmpgt_epi16(a.bits, b.bits)};
}
inline bool any(I16x8 mask) {
  return _mm_movemask_epi8(mask.bits) != 0;
}
inline I16x8 interleaved_low(I16x8 a, I16x8 b) {
  return {_mm_unpacklo_epi16(a.bits, b.bits)};
}
inline I16x8 interleaved_high(I16x8 a, I16x8 b) {
  return {_mm_unpackhi_epi16(a.bits, b.bits)};
}
inline I16x8 interleaved_pairs_low(I16x8 a, I16x8 b) {
  return {_mm_unpacklo_epi32(a.bits, b.bits)};
}
inline I16x8 interleaved_pairs_high(I16x8 a, I16x8 b) {
  return {_mm_unpackhi_epi32(a.bits, b.bits)};
}
inline I16x8 low_halves(I16x8 a, I16x8 b) {
  return {_mm_unpacklo_epi64(a.bits, b.bits)};
}
inline I16x8 high_halves(I16x8 a, I16x8 b) {
  return {_mm_unpackhi_epi64(a.bits, b.bits)};
}
inline I16x8 looked_up(const std::int16_t* table, I16x8 index) {
  __m128i out = _mm_setzero_si128();
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 0)], 0);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 1)], 1);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 2)], 2);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 3)], 3);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 4)], 4);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 5)], 5);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 6)], 6);
  out = _mm_insert_epi16(out, table[_mm_extract_epi16(index.bits, 7)], 7);
  return {out};
}
inline std::int16_t largest_lane(I16x8 a) {
  __m128i m = _mm_max_epi16(a.bits, _mm_srli_si128(a.bits, 8));
  m = _mm_max_epi16(m, _mm_srli_si128(m, 4));
  m = _mm_max_epi16(m, _mm_srli_si128(m, 2));
  return static_cast<std::int16_t>(_mm_cvtsi128_si32(m));
}

// Thirty-two bits.

inline I32x4 splat_sum(std::int32_t value) {
  return {_mm_set1_epi32(value)};
}
inline I32x4 operator+(I32x4 a, I32x4 b) {
  return {_mm_add_epi32(a.bits, b.bits)};
}
template <int bits>
I32x4 shifted_left(I32x4 a) {
  return {_mm_slli_epi32(a.bits, bits)};
}
template <int bits>
I32x4 shifted_right(I32x4 a) {
  return {_mm_srai_epi32(a.bits, bits)};
}
inline I32x4 shifted_left_by(I32x4 a, int bits) {
  return {_mm_sll_epi32(a.bits, _mm_cvtsi32_si128(bits))};
}
inline I32x4 shifted_right_by(I32x4 a, int bits) {
  return {_mm_sra_epi32(a.bits, _mm_cvtsi32_si128(bits))};
}
inline I32x4 magnitude(I32x4 a) {
  return {_mm_abs_epi32(a.bits)};
}
inline I32x4 pair_sums(I16x8 a, I16x8 b) {
  return {_mm_madd_epi16(a.bits, b.bits)};
}
inline I16x8 packed(I32x4 a, I32x4 b) {
  return {_mm_packs_epi32(a.bits, b.bits)};
}

// Bytes.

inline U8x16 interleaved_low(U8x16 a, U8x16 b) {
  return {_mm_unpacklo_epi8(a.bits, b.bits)};
}
inline U8x16 interleaved_high(U8x16 a, U8x16 b) {
  return {_mm_unpackhi_epi8(a.bits, b.bits)};
}
inline U8x16 interleaved_quads_low(U8x16 a, U8x16 b) {
  return {_mm_unpacklo_epi32(a.bits, b.bits)};
}
inline U8x16 interleaved_quads_high(U8x16 a, U8x16 b) {
  return {_mm_unpackhi_epi32(a.bits, b.bits)};
}
inline U8x16 high_half(U8x16 a) {
  return {_mm_unpackhi_epi64(a.bits, a.bits)};
}
inline I16x8 widened_low(U8x16 a) {
  return {_mm_unpacklo_epi8(a.bits, _mm_setzero_si128())};
}
inline I16x8 widened_high(U8x16 a) {
  return {_mm_unpackhi_epi8(a.bits, _mm_setzero_si128())};
}
template <int a_weight, int b_weight>
I16x8 weighted_pairs(U8x16 pairs) {
  static_assert(a_weight >= 0 && b_weight >= 0 && a_weight + b_weight < 128);
  return {_mm_maddubs_epi16(pairs.bits, _mm_set1_epi16(a_weight | b_weight << 8))};
}
template <int a_weight, int b_weight>
I16x8 weighted_low(U8x16 a, U8x16 b) {
  return weighted_pairs<a_weight, b_weight>(interleaved_low(a, b));
}
template <int a_weight, int b_weight>
I16x8 weighted_high(U8x16 a, U8x16 b) {
  return weighted_pairs<a_weight, b_weight>(interleaved_high(a, b));
}

}  // namespace gazed::saliency::ssse3
