// Both sets of lanes do the same, operation by operation: kernels are written once on top of them.
#include "agent/saliency/lanes.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <random>

#if defined(__SSSE3__)

namespace gazed::saliency::lanes_test {
namespace {

using Bits = std::array<std::uint8_t, 16>;

template <typename V>
V lanes_of(const Bits& bits) {
  static_assert(sizeof(V) == sizeof(Bits));
  V out;
  std::memcpy(&out, bits.data(), sizeof(out));
  return out;
}

template <typename V>
Bits bits_of(const V& lanes) {
  Bits out;
  std::memcpy(out.data(), &lanes, sizeof(out));
  return out;
}

/// Random bits, often with the lanes that are likely to go wrong: 0, -1, the largest, the smallest.
class Inputs {
 public:
  Bits next() {
    constexpr std::array<std::uint16_t, 6> edges{0, 0xffff, 0x7fff, 0x8000, 1, 0x8001};
    std::array<std::uint16_t, 8> lanes;
    for (std::uint16_t& lane : lanes)
      lane = random_() % 4 == 0 ? edges[random_() % edges.size()]
                                : static_cast<std::uint16_t>(random_());
    Bits out;
    std::memcpy(out.data(), lanes.data(), sizeof(out));
    return out;
  }

 private:
  std::mt19937_64 random_{1};
};

constexpr int trials = 2000;

/// `operation` is called with the lanes of either set and returns lanes, the same bits.
template <typename Ssse3, typename Plain, typename F>
void expect_same(F operation, const char* name) {
  Inputs inputs;
  for (int i = 0; i < trials; ++i) {
    const Bits a = inputs.next(), b = inputs.next();
    const Bits simd = bits_of(operation(lanes_of<Ssse3>(a), lanes_of<Ssse3>(b)));
    const Bits scalar = bits_of(operation(lanes_of<Plain>(a), lanes_of<Plain>(b)));
    ASSERT_EQ(simd, scalar) << name << " of " << testing::PrintToString(a) << " and "
                            << testing::PrintToString(b);
  }
}

template <typename F>
void same_of_16_bits(F operation, const char* name) {
  expect_same<ssse3::I16x8, plain::I16x8>(operation, name);
}
template <typename F>
void same_of_32_bits(F operation, const char* name) {
  expect_same<ssse3::I32x4, plain::I32x4>(operation, name);
}
template <typename F>
void same_of_bytes(F operation, const char* name) {
  expect_same<ssse3::U8x16, plain::U8x16>(operation, name);
}

TEST(Lanes, ArithmeticOf16Bits) {
  same_of_16_bits([](auto a, auto b) { return a + b; }, "+");
  same_of_16_bits([](auto a, auto b) { return a - b; }, "-");
  same_of_16_bits([](auto a, auto b) { return a & b; }, "&");
  same_of_16_bits([](auto a, auto b) { return without(a, b); }, "without");
  same_of_16_bits([](auto a, auto b) { return smaller(a, b); }, "smaller");
  same_of_16_bits([](auto a, auto b) { return larger(a, b); }, "larger");
  same_of_16_bits([](auto a, auto b) { return is_greater(a, b); }, "is_greater");
  same_of_16_bits([](auto a, auto) { return magnitude(a); }, "magnitude");
  same_of_16_bits([](auto a, auto) { return shifted_left<5>(a); }, "shifted_left");
  same_of_16_bits([](auto a, auto) { return shifted_left_by(a, 9); }, "shifted_left_by");
  same_of_16_bits([](auto a, auto) { return shifted_right<4>(a); }, "shifted_right");
  same_of_16_bits([](auto a, auto) { return shifted_right_unsigned<4>(a); },
                  "shifted_right_unsigned");
  same_of_16_bits([](auto a, auto b) { return times_q15(shifted_right<1>(a), b); }, "times_q15");
}

TEST(Lanes, OrderOf16Bits) {
  same_of_16_bits([](auto a, auto b) { return interleaved_low(a, b); }, "interleaved_low");
  same_of_16_bits([](auto a, auto b) { return interleaved_high(a, b); }, "interleaved_high");
  same_of_16_bits([](auto a, auto b) { return interleaved_pairs_low(a, b); }, "pairs_low");
  same_of_16_bits([](auto a, auto b) { return interleaved_pairs_high(a, b); }, "pairs_high");
  same_of_16_bits([](auto a, auto b) { return low_halves(a, b); }, "low_halves");
  same_of_16_bits([](auto a, auto b) { return high_halves(a, b); }, "high_halves");
}

TEST(Lanes, Widths) {
  same_of_16_bits([](auto a, auto b) { return pair_sums(shifted_right<1>(a), b); }, "pair_sums");
  same_of_32_bits([](auto a, auto b) { return packed(a, b); }, "packed");
  same_of_bytes([](auto a, auto) { return widened_low(a); }, "widened_low");
  same_of_bytes([](auto a, auto) { return widened_high(a); }, "widened_high");
  same_of_bytes([](auto a, auto b) { return weighted_low<6, 4>(a, b); }, "weighted_low");
  same_of_bytes([](auto a, auto b) { return weighted_high<1, 4>(a, b); }, "weighted_high");
}

TEST(Lanes, ArithmeticOf32Bits) {
  same_of_32_bits([](auto a, auto b) { return a + b; }, "+");
  same_of_32_bits([](auto a, auto) { return shifted_left<3>(a); }, "shifted_left");
  same_of_32_bits([](auto a, auto) { return shifted_right<8>(a); }, "shifted_right");
  same_of_32_bits([](auto a, auto) { return shifted_left_by(a, 7); }, "shifted_left_by");
  same_of_32_bits([](auto a, auto) { return shifted_right_by(a, 31); }, "shifted_right_by");
  same_of_32_bits([](auto a, auto) { return magnitude(shifted_right<1>(a)); }, "magnitude");
}

TEST(Lanes, OrderOfBytes) {
  same_of_bytes([](auto a, auto b) { return interleaved_low(a, b); }, "interleaved_low");
  same_of_bytes([](auto a, auto b) { return interleaved_high(a, b); }, "interleaved_high");
  same_of_bytes([](auto a, auto b) { return interleaved_quads_low(a, b); }, "quads_low");
  same_of_bytes([](auto a, auto b) { return interleaved_quads_high(a, b); }, "quads_high");
  same_of_bytes([](auto a, auto) { return high_half(a); }, "high_half");
}

TEST(Lanes, Reductions) {
  Inputs inputs;
  for (int i = 0; i < trials; ++i) {
    const Bits a = inputs.next();
    EXPECT_EQ(largest_lane(lanes_of<ssse3::I16x8>(a)), largest_lane(lanes_of<plain::I16x8>(a)));
  }
  EXPECT_FALSE(any(ssse3::splat(0)));
  EXPECT_FALSE(any(plain::splat(0)));
  EXPECT_TRUE(any(is_greater(ssse3::multiples(1), ssse3::splat(6))));
  EXPECT_TRUE(any(is_greater(plain::multiples(1), plain::splat(6))));
}

TEST(Lanes, MemoryAndTables) {
  alignas(16) std::array<std::int16_t, 24> samples;
  alignas(16) std::array<std::uint8_t, 32> bytes;
  std::mt19937_64 random(2);
  for (std::int16_t& s : samples) s = static_cast<std::int16_t>(random());
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
  EXPECT_EQ(bits_of(ssse3::load(samples.data())), bits_of(plain::load(samples.data())));
  EXPECT_EQ(bits_of(ssse3::load_unaligned(samples.data() + 3)),
            bits_of(plain::load_unaligned(samples.data() + 3)));
  EXPECT_EQ(bits_of(ssse3::load_half(samples.data() + 5)),
            bits_of(plain::load_half(samples.data() + 5)));
  EXPECT_EQ(bits_of(ssse3::load_unaligned(bytes.data() + 7)),
            bits_of(plain::load_unaligned(bytes.data() + 7)));
  EXPECT_EQ(bits_of(ssse3::load_half(bytes.data() + 7)),
            bits_of(plain::load_half(bytes.data() + 7)));
  EXPECT_EQ(bits_of(ssse3::splat(-7)), bits_of(plain::splat(-7)));
  EXPECT_EQ(bits_of(ssse3::splat_sum(-70000)), bits_of(plain::splat_sum(-70000)));
  EXPECT_EQ(bits_of(ssse3::multiples(4096)), bits_of(plain::multiples(4096)));
  EXPECT_EQ(bits_of(looked_up(samples.data(), ssse3::multiples(3))),
            bits_of(looked_up(samples.data(), plain::multiples(3))));
}

/// What is stored is what is loaded again, and only its place is written.
template <typename Ssse3, typename Plain, typename Sample>
void expect_same_memory() {
  constexpr std::size_t lanes = sizeof(Bits) / sizeof(Sample);
  using Memory = std::array<Sample, 3 * lanes>;
  Inputs inputs;
  for (int i = 0; i < trials; ++i) {
    const Bits a = inputs.next();
    alignas(16) Memory simd{}, scalar{};
    Memory wanted{};
    std::memcpy(wanted.data() + lanes, a.data(), sizeof(a));
    store(simd.data() + lanes, lanes_of<Ssse3>(a));
    store(scalar.data() + lanes, lanes_of<Plain>(a));
    ASSERT_EQ(simd, wanted);
    ASSERT_EQ(scalar, wanted);
    ASSERT_EQ(bits_of(ssse3::load(simd.data() + lanes)), a);
    ASSERT_EQ(bits_of(plain::load(simd.data() + lanes)), a);
  }
}

TEST(Lanes, StoresAndLoads) {
  expect_same_memory<ssse3::I16x8, plain::I16x8, std::int16_t>();
  expect_same_memory<ssse3::I32x4, plain::I32x4, std::int32_t>();
}

}  // namespace
}  // namespace gazed::saliency::lanes_test

#endif
