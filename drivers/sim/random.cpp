#include "drivers/sim/random.hpp"

#include <cmath>
#include <numbers>

namespace gazed::sim {

namespace {

// One step of SplitMix64 (Steele, Lea and Flood 2014): neighbouring seeds give unrelated states.
std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t stream)
    : engine_(scrambled(scrambled(seed) + stream)) {}

double RandomStream::uniform() {
  return static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
}

double RandomStream::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

}  // namespace gazed::sim
