// Random numbers that are the same on every machine: the standard fixes the engine's output, but
// not what its distributions make of it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "agent/geometry/head.hpp"

namespace gazed::triangulation {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Standard normal (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  Eigen::Vector2d normal_2() {
    const double x = normal();
    return {x, normal()};
  }
  Eigen::Vector3d normal_3() {
    const Eigen::Vector2d xy = normal_2();
    return {xy.x(), xy.y(), normal()};
  }

 private:
  std::mt19937_64 engine_;
};

/// Both angles normal about 0.
inline geometry::HeadAngles random_angles(double sigma_rad, Random& random) {
  const Eigen::Vector2d error = sigma_rad * random.normal_2();
  return {error.x(), error.y()};
}

}  // namespace gazed::triangulation
