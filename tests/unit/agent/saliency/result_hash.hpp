// One number for all the bits of a look.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "agent/saliency/saliency.hpp"

namespace gazed::saliency {

/// FNV-1a, 64 bit (Fowler, Noll, Vo), over numbers whose low bytes come first.
class Fnv1a {
 public:
  template <std::unsigned_integral T>
  void add(T number) {
    for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
      hash_ ^= static_cast<std::uint8_t>(number >> (8 * byte));
      hash_ *= 0x100000001b3;
    }
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// Of the map's samples, the peak, the saliency and the distinctness, in this order.
[[nodiscard]] inline std::uint64_t hash_of(const SaliencyResult& result) {
  Fnv1a hash;
  for (const std::uint16_t sample : result.map.samples) hash.add(sample);
  for (const double coordinate : result.peak_px) hash.add(std::bit_cast<std::uint64_t>(coordinate));
  for (const float value : {result.saliency, result.distinctness})
    hash.add(std::bit_cast<std::uint32_t>(value));
  return hash.value();
}

}  // namespace gazed::saliency
