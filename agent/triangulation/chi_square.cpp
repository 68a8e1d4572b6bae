#include "agent/triangulation/chi_square.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "agent/triangulation/gate.hpp"

namespace gazed::triangulation {

double chi2_999_of(int degrees_of_freedom) {
  static constexpr std::array<double, 31> table{
      0.0,    chi2_999, 13.816, 16.266, 18.467, 20.515, 22.458, 24.322, 26.124, 27.877, 29.588,
      31.264, 32.909,   34.528, 36.123, 37.697, 39.252, 40.790, 42.312, 43.820, 45.315, 46.797,
      48.268, 49.728,   51.179, 52.620, 54.052, 55.476, 56.892, 58.301, 59.703};
  if (degrees_of_freedom <= 0) return 0.0;
  if (degrees_of_freedom < static_cast<int>(table.size())) {
    return table[static_cast<std::size_t>(degrees_of_freedom)];
  }
  constexpr double normal_999 = 3.090232;  // 99.9 % of the standard normal, one-sided
  const double degrees = degrees_of_freedom;
  const double variance = 2.0 / (9.0 * degrees);
  const double root = 1.0 - variance + normal_999 * std::sqrt(variance);
  return degrees * root * root * root;
}

}  // namespace gazed::triangulation
