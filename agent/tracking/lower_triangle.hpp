// Sums of outer products: they are symmetric, so half the work is enough.
#pragma once

#include <Eigen/Core>

namespace gazed::tracking {

/// Adds a b^T, where a is a multiple of b, to the lower triangle of `sum`. The upper triangle is
/// not meaningful afterwards.
template <int first = 0, int size>
void add_lower_triangle(const Eigen::Matrix<double, size, 1>& a,
                        const Eigen::Matrix<double, size, 1>& b,
                        Eigen::Matrix<double, size, size>& sum) {
  static_assert(size % 2 == 0);
  if constexpr (first < size) {
    // Two columns start at the same row, where vectors of two doubles are aligned.
    constexpr int rows = size - first;
    for (int k = first; k < first + 2; ++k) {
      sum.col(k).template tail<rows>() += b[k] * a.template tail<rows>();
    }
    add_lower_triangle<first + 2>(a, b, sum);
  }
}

}  // namespace gazed::tracking
