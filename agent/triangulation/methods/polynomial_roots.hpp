// The roots of a polynomial of low degree, as the eigenvalues of its companion matrix.
//
// Eigen's RealSchur does the same, but for matrices of up to six rows it takes as long to compile
// as all other methods together.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace gazed::triangulation::methods {

inline constexpr int degree_max = 6;
/// Coefficient k belongs to t^k.
using Polynomial = std::array<double, degree_max + 1>;

struct RealParts {
  std::array<double, degree_max> all{};
  int count = 0;

  void add(double value) { all[static_cast<std::size_t>(count++)] = value; }
  [[nodiscard]] std::span<const double> values() const {
    return std::span(all).first(static_cast<std::size_t>(count));
  }
};

/// The real parts of all roots, accurate to rounding; a conjugate pair gives the same value twice.
/// Leading coefficients below `negligible` times the largest are dropped: their roots are far
/// outside [-1, 1]. None if a coefficient is not finite, and for a constant.
[[nodiscard]] RealParts real_parts_of_roots(const Polynomial& g, double negligible);

}  // namespace gazed::triangulation::methods
