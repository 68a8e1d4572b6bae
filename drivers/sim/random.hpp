// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>
#include <random>

namespace gazed::sim {

/// One stream of a seed; streams of the same seed with other numbers are independent, so that one
/// source of noise can be switched off without changing the others.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream);

  /// In [0, 1), 53 bits.
  [[nodiscard]] double uniform();
  /// In [-1, 1).
  [[nodiscard]] double symmetric() { return 2.0 * uniform() - 1.0; }
  /// Mean 0, standard deviation 1 (Box and Muller 1958).
  [[nodiscard]] double gaussian();
  [[nodiscard]] std::uint64_t bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace gazed::sim
