// Random numbers that are the same on every machine, bit for bit.
//
// The standard fixes what an engine gives, but not what its distributions make of it; and a
// logarithm or a sine may differ in its last bit from one C library, or one CPU, to another. So
// nothing is used here but the engine and what IEEE 754 rounds exactly.
#pragma once

#include <cstdint>
#include <random>

namespace gazed::base {

constexpr std::uint64_t split_mix_step = 0x9E3779B97F4A7C15U;

/// One step of SplitMix64 (Steele, Lea and Flood 2014): neighbouring states give unrelated numbers.
[[nodiscard]] inline std::uint64_t split_mix(std::uint64_t& state) {
  std::uint64_t x = state += split_mix_step;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// As so many steps would leave it.
inline void skip_split_mix(std::uint64_t& state, std::uint64_t steps) {
  state += steps * split_mix_step;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// One stream of a seed; streams of the same seed with other numbers are independent, so that one
  /// source of noise can be switched off without changing the others.
  Random(std::uint64_t seed, std::uint64_t stream);

  [[nodiscard]] std::uint64_t bits() { return engine_(); }
  /// In [0, 1), 53 bits.
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  /// In [low, high).
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [-1, 1).
  [[nodiscard]] double symmetric() { return 2.0 * uniform() - 1.0; }
  /// Mean 0, standard deviation 1 (Box and Muller 1958).
  [[nodiscard]] double normal();

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace gazed::base
