// The lanes of lanes.hpp for any processor: what the SSSE3 instructions do, written as arithmetic.
//
// The lanes use gcc's vector extension, which maps them to whatever the processor offers, single
// samples if need be.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace gazed::saliency::plain {

template <typename T>
struct Lanes {
  using Lane = T;
  static constexpr std::size_t count = 16 / sizeof(T);
  using Vector [[gnu::vector_size(16)]] = T;
  Vector lane;
};
using I16x8 = Lanes<std::int16_t>;
using I32x4 = Lanes<std::int32_t>;
using U8x16 = Lanes<std::uint8_t>;

/// f(i) in lane i, whatever bits of it fit.
template <typename Out, typename F>
constexpr Out each(F f) {
  return [&f]<std::size_t... i>(std::index_sequence<i...>) {
    return Out{typename Out::Vector{static_cast<typename Out::Lane>(f(i))...}};
  }
  (std::make_index_sequence<Out::count>{});
}

/// The same bits: sums that wrap are sums of unsigned numbers.
template <typename T>
constexpr auto as_unsigned(Lanes<T> a) {
  return __builtin_convertvector(a.lane, typename Lanes<std::make_unsigned_t<T>>::Vector);
}
template <typename Out, typename Vector>
constexpr Out as(Vector bits) {
  return {__builtin_convertvector(bits, typename Out::Vector)};
}

// Memory. As with SSE, `load` and `store` need an address that is a multiple of 16.

template <typename Out>
Out copied_from(const void* from, std::size_t bytes = sizeof(Out)) {
  Out out{};
  std::memcpy(&out, from, bytes);
  return out;
}
inline I16x8 load_unaligned(const std::int16_t* from) {
  return copied_from<I16x8>(from);
}
inline I16x8 load(const std::int16_t* from) {
  return copied_from<I16x8>(from);
}
inline void store(std::int16_t* to, I16x8 a) {
  std::memcpy(to, &a, sizeof(a));
}
inline I32x4 load(const std::int32_t* from) {
  return copied_from<I32x4>(from);
}
inline void store(std::int32_t* to, I32x4 a) {
  std::memcpy(to, &a, sizeof(a));
}
inline U8x16 load_unaligned(const std::uint8_t* from) {
  return copied_from<U8x16>(from);
}
/// Four samples or eight bytes; the rest 0.
inline I16x8 load_half(const std::int16_t* from) {
  return copied_from<I16x8>(from, sizeof(I16x8) / 2);
}
inline U8x16 load_half(const std::uint8_t* from) {
  return copied_from<U8x16>(from, sizeof(U8x16) / 2);
}

// Sixteen bits.

constexpr I16x8 splat(std::int16_t value) {
  return each<I16x8>([value](std::size_t) { return value; });
}
/// 0, step, 2 step, ...
constexpr I16x8 multiples(std::int16_t step) {
  return each<I16x8>([step](std::size_t i) { return static_cast<int>(i) * step; });
}
constexpr I16x8 operator+(I16x8 a, I16x8 b) {
  return as<I16x8>(as_unsigned(a) + as_unsigned(b));
}
constexpr I16x8 operator-(I16x8 a, I16x8 b) {
  return as<I16x8>(as_unsigned(a) - as_unsigned(b));
}
constexpr I16x8 operator&(I16x8 a, I16x8 b) {
  return {a.lane & b.lane};
}
/// a where the mask is 0, 0 where it is -1.
constexpr I16x8 without(I16x8 a, I16x8 mask) {
  return {a.lane & ~mask.lane};
}
template <int bits>
constexpr I16x8 shifted_left(I16x8 a) {
  return as<I16x8>(as_unsigned(a) << bits);
}
/// 0 <= bits < 16.
constexpr I16x8 shifted_left_by(I16x8 a, int bits) {
  return as<I16x8>(as_unsigned(a) << static_cast<std::uint16_t>(bits));
}
template <int bits>
constexpr I16x8 shifted_right(I16x8 a) {
  return {a.lane >> bits};
}
template <int bits>
constexpr I16x8 shifted_right_unsigned(I16x8 a) {
  return as<I16x8>(as_unsigned(a) >> bits);
}
constexpr I16x8 smaller(I16x8 a, I16x8 b) {
  return {a.lane < b.lane ? a.lane : b.lane};
}
constexpr I16x8 larger(I16x8 a, I16x8 b) {
  return {a.lane > b.lane ? a.lane : b.lane};
}
constexpr I16x8 magnitude(I16x8 a) {
  return larger(a, I16x8{} - a);
}
/// -1 where a > b, else 0.
constexpr I16x8 is_greater(I16x8 a, I16x8 b) {
  return as<I16x8>(a.lane > b.lane);
}
/// True if a mask is not 0 everywhere.
inline bool any(I16x8 mask) {
  std::uint64_t halves[2];  // NOLINT: as memcpy wants it
  std::memcpy(halves, &mask, sizeof(mask));
  return (halves[0] | halves[1]) != 0;
}
constexpr std::int16_t largest_lane(I16x8 a) {
  std::int16_t largest = a.lane[0];
  for (std::size_t i = 1; i < I16x8::count; ++i)
    largest = std::max(largest, std::int16_t{a.lane[i]});
  return largest;
}
/// The table's entry at each lane of `index`, which is not negative.
constexpr I16x8 looked_up(const std::int16_t* table, I16x8 index) {
  return each<I16x8>([=](std::size_t i) { return table[index.lane[i]]; });
}

/// Groups of `size` lanes of a and b in turn, from group `first` on: a, b, a, b, ...
template <std::size_t size, std::size_t first, typename V>
constexpr V interleaved_groups(V a, V b) {
  const auto from = [](std::size_t i) {
    return (first + i / size / 2) * size + i % size + (i / size % 2) * V::count;
  };
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return V{__builtin_shufflevector(a.lane, b.lane, from(i)...)};
  }
  (std::make_index_sequence<V::count>{});
}
constexpr I16x8 interleaved_low(I16x8 a, I16x8 b) {
  return interleaved_groups<1, 0>(a, b);
}
constexpr I16x8 interleaved_high(I16x8 a, I16x8 b) {
  return interleaved_groups<1, 4>(a, b);
}
constexpr I16x8 interleaved_pairs_low(I16x8 a, I16x8 b) {
  return interleaved_groups<2, 0>(a, b);
}
constexpr I16x8 interleaved_pairs_high(I16x8 a, I16x8 b) {
  return interleaved_groups<2, 2>(a, b);
}
constexpr I16x8 low_halves(I16x8 a, I16x8 b) {
  return interleaved_groups<4, 0>(a, b);
}
constexpr I16x8 high_halves(I16x8 a, I16x8 b) {
  return interleaved_groups<4, 1>(a, b);
}

// Thirty-two bits. Sums wrap.

constexpr I32x4 splat_sum(std::int32_t value) {
  return each<I32x4>([value](std::size_t) { return value; });
}
constexpr I32x4 operator+(I32x4 a, I32x4 b) {
  return as<I32x4>(as_unsigned(a) + as_unsigned(b));
}
template <int bits>
constexpr I32x4 shifted_left(I32x4 a) {
  return as<I32x4>(as_unsigned(a) << bits);
}
template <int bits>
constexpr I32x4 shifted_right(I32x4 a) {
  return {a.lane >> bits};
}
/// 0 <= bits < 32.
constexpr I32x4 shifted_left_by(I32x4 a, int bits) {
  return as<I32x4>(as_unsigned(a) << static_cast<unsigned>(bits));
}
constexpr I32x4 shifted_right_by(I32x4 a, int bits) {
  return {a.lane >> bits};
}
constexpr I32x4 magnitude(I32x4 a) {
  return {a.lane < 0 ? -a.lane : a.lane};
}
/// Every `stride`-th lane from `first` on, in lanes of twice the width.
template <typename Out, std::size_t first, std::size_t stride, typename V>
constexpr Out widened(V a) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return as<Out>(__builtin_shufflevector(a.lane, a.lane, (first + i * stride)...));
  }
  (std::make_index_sequence<Out::count>{});
}
/// Products of neighbouring lanes, added: a0 b0 + a1 b1, a2 b2 + a3 b3, ...
constexpr I32x4 pair_sums(I16x8 a, I16x8 b) {
  return {widened<I32x4, 0, 2>(a).lane * widened<I32x4, 0, 2>(b).lane +
          widened<I32x4, 1, 2>(a).lane * widened<I32x4, 1, 2>(b).lane};
}
/// The lanes of a, then those of b, saturated to 16 bits.
constexpr I16x8 packed(I32x4 a, I32x4 b) {
  using Half [[gnu::vector_size(8)]] = std::int16_t;
  const auto narrowed = [](I32x4 v) {
    using Limits = std::numeric_limits<std::int16_t>;
    const auto low = v.lane < Limits::min() ? splat_sum(Limits::min()).lane : v.lane;
    const auto both = low > Limits::max() ? splat_sum(Limits::max()).lane : low;
    return __builtin_convertvector(both, Half);
  };
  return {__builtin_shufflevector(narrowed(a), narrowed(b), 0, 1, 2, 3, 4, 5, 6, 7)};
}
/// a b / 2^15, rounded; not for -2^15 times itself.
constexpr I16x8 times_q15(I16x8 a, I16x8 b) {
  const auto product = [](I32x4 x, I32x4 y) { return I32x4{(x.lane * y.lane + (1 << 14)) >> 15}; };
  return packed(product(widened<I32x4, 0, 1>(a), widened<I32x4, 0, 1>(b)),
                product(widened<I32x4, 4, 1>(a), widened<I32x4, 4, 1>(b)));
}

// Bytes.

constexpr U8x16 interleaved_low(U8x16 a, U8x16 b) {
  return interleaved_groups<1, 0>(a, b);
}
constexpr U8x16 interleaved_high(U8x16 a, U8x16 b) {
  return interleaved_groups<1, 8>(a, b);
}
constexpr U8x16 interleaved_quads_low(U8x16 a, U8x16 b) {
  return interleaved_groups<4, 0>(a, b);
}
constexpr U8x16 interleaved_quads_high(U8x16 a, U8x16 b) {
  return interleaved_groups<4, 2>(a, b);
}
/// The high half in the place of the low one.
constexpr U8x16 high_half(U8x16 a) {
  return interleaved_groups<8, 1>(a, a);
}
/// The first or the last eight bytes.
constexpr I16x8 widened_low(U8x16 a) {
  return widened<I16x8, 0, 1>(a);
}
constexpr I16x8 widened_high(U8x16 a) {
  return widened<I16x8, 8, 1>(a);
}
/// a_weight a + b_weight b of the first or the last eight bytes; weights are positive and their sum
/// below 128.
template <int a_weight, int b_weight>
constexpr I16x8 weighted_low(U8x16 a, U8x16 b) {
  static_assert(a_weight >= 0 && b_weight >= 0 && a_weight + b_weight < 128);
  constexpr std::int16_t weight_a = a_weight, weight_b = b_weight;
  return {widened_low(a).lane * weight_a + widened_low(b).lane * weight_b};
}
template <int a_weight, int b_weight>
constexpr I16x8 weighted_high(U8x16 a, U8x16 b) {
  return weighted_low<a_weight, b_weight>(high_half(a), high_half(b));
}

}  // namespace gazed::saliency::plain
