#include "agent/geometry/singular_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gazed::geometry {

namespace {

using Eigen::Index;

double dot(const double* x, const double* y, Index size) {
  double sum = 0.0;
  for (Index i = 0; i < size; ++i) sum += x[i] * y[i];
  return sum;
}

void turn(double* x, double* y, Index size, double cosine, double sine) {
  for (Index i = 0; i < size; ++i) {
    const double old = x[i];
    x[i] = cosine * old - sine * y[i];
    y[i] = sine * old + cosine * y[i];
  }
}

}  // namespace

void decompose(Eigen::Ref<Eigen::MatrixXd> a, Eigen::Ref<Eigen::MatrixXd> v) {
  constexpr int sweeps_max = 40;  // five to ten are usual
  const Index rows = a.rows(), size = a.cols();
  v.setIdentity();
  bool turned = true;
  for (int sweep = 0; turned && sweep < sweeps_max; ++sweep) {
    turned = false;
    for (Index p = 0; p < size; ++p) {
      for (Index q = p + 1; q < size; ++q) {
        const double length2_p = dot(&a(0, p), &a(0, p), rows);
        const double length2_q = dot(&a(0, q), &a(0, q), rows);
        const double common = dot(&a(0, p), &a(0, q), rows);
        const double rounding = std::numeric_limits<double>::epsilon();
        if (!(std::abs(common) > rounding * std::sqrt(length2_p) * std::sqrt(length2_q))) continue;
        turned = true;
        const double cotangent = (length2_q - length2_p) / (2.0 * common);  // of twice the angle
        const double tangent =
            std::copysign(1.0, cotangent) / (std::abs(cotangent) + std::hypot(1.0, cotangent));
        const double cosine = 1.0 / std::hypot(1.0, tangent);
        turn(&a(0, p), &a(0, q), rows, cosine, cosine * tangent);
        turn(&v(0, p), &v(0, q), size, cosine, cosine * tangent);
      }
    }
  }
  for (Index i = 0; i < size; ++i) {
    Index shortest = i;
    for (Index k = i + 1; k < size; ++k) {
      if (dot(&a(0, k), &a(0, k), rows) < dot(&a(0, shortest), &a(0, shortest), rows)) shortest = k;
    }
    if (shortest == i) continue;
    std::swap_ranges(&a(0, i), &a(0, i) + rows, &a(0, shortest));
    std::swap_ranges(&v(0, i), &v(0, i) + size, &v(0, shortest));
  }
}

}  // namespace gazed::geometry
