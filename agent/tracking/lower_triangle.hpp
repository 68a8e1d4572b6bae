// Sums of outer products, which are symmetric: one half of the work.
#pragma once

#include <Eigen/Core>

namespace gazed::tracking {

/// Adds a b^T, where a is b but for a factor, to the lower triangle of `sum`. What is above means
/// nothing.
template <int first = 0, int size>
void add_lower_triangle(const Eigen::Matrix<double, size, 1>& a,
                        const Eigen::Matrix<double, size, 1>& b,
                        Eigen::Matrix<double, size, size>& sum) {
  static_assert(size % 2 == 0);
  if constexpr (first < size) {
    // Two columns from the same row on: vectors of two doubles are aligned there.
    constexpr int rows = size - first;
    for (int k = first; k < first + 2; ++k) {
      sum.col(k).template tail<rows>() += b[k] * a.template tail<rows>();
    }
    add_lower_triangle<first + 2>(a, b, sum);
  }
}

}  // namespace gazed::tracking
