#include "agent/triangulation/methods/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gazed::triangulation::methods {

namespace {

/// An upper Hessenberg matrix, and its eigenvalues by the QR algorithm with Francis' double shifts
/// (Martin, Peters and Wilkinson 1970, "hqr").
class Hessenberg {
 public:
  explicit Hessenberg(int size) : size_(size) {}

  [[nodiscard]] double& at(int row, int column) {
    return m_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  }

  /// Osborne's balancing by powers of two (Parlett and Reinsch 1969). Without it, if the roots
  /// differ by many orders of magnitude, the small ones are lost in the rounding of the large ones.
  void balance();
  /// Real parts in any order; fewer than the degree if the iteration does not converge. Destroys
  /// the matrix.
  [[nodiscard]] RealParts eigenvalues();

 private:
  struct Shift {
    double x = 0.0, y = 0.0,
           w = 0.0;  // the last diagonal element, the one before it, and the product beside them
  };
  struct Reflector {
    double p = 0.0, q = 0.0, r = 0.0;
  };

  [[nodiscard]] int block_start(int end, double norm);
  [[nodiscard]] double norm();
  [[nodiscard]] Shift shift_of(int end);
  [[nodiscard]] Shift exceptional_shift(int end);
  void add_pair(int end);
  [[nodiscard]] int start_of_step(int first, int end, const Shift& shift, Reflector& reflector);
  void double_step(int first, int end, const Shift& shift);
  void reflect(int first, int k, int end, const Reflector& reflector, double s);

  static constexpr double rounding = std::numeric_limits<double>::epsilon();

  int size_;
  RealParts found_;
  double shifted_ = 0.0;  // subtracted from the diagonal by exceptional shifts
  std::array<std::array<double, degree_max>, degree_max> m_{};
};

void Hessenberg::balance() {
  constexpr int sweeps_max = 20;  // two or three are usual
  bool changed = true;
  for (int sweep = 0; changed && sweep < sweeps_max; ++sweep) {
    changed = false;
    for (int i = 0; i < size_; ++i) {
      double column = 0.0, row = 0.0;
      for (int k = 0; k < size_; ++k) {
        if (k == i) continue;
        column += std::abs(at(k, i));
        row += std::abs(at(i, k));
      }
      if (!(column > 0.0 && row > 0.0)) continue;
      const int exponent = (std::ilogb(row) - std::ilogb(column)) / 2;
      if (exponent == 0) continue;
      for (int k = 0; k < size_; ++k) {
        at(k, i) *= std::ldexp(1.0, exponent);
        at(i, k) *= std::ldexp(1.0, -exponent);
      }
      changed = true;
    }
  }
}

double Hessenberg::norm() {
  double sum = 0.0;
  for (int i = 0; i < size_; ++i) {
    for (int k = std::max(i - 1, 0); k < size_; ++k) sum += std::abs(at(i, k));
  }
  return sum;
}

/// Where the block that ends at `end` begins: below a subdiagonal element that is only rounding.
int Hessenberg::block_start(int end, double norm) {
  int first = end;
  for (; first > 0; --first) {
    double size = std::abs(at(first - 1, first - 1)) + std::abs(at(first, first));
    if (size == 0.0) size = norm;
    if (std::abs(at(first, first - 1)) <= rounding * size) {
      at(first, first - 1) = 0.0;
      break;
    }
  }
  return first;
}

Hessenberg::Shift Hessenberg::shift_of(int end) {
  return {at(end, end), at(end - 1, end - 1), at(end, end - 1) * at(end - 1, end)};
}

/// The row where the double step may begin, because two small subdiagonal elements follow one
/// another there; also returns the first column of the shifted product.
int Hessenberg::start_of_step(int first, int end, const Shift& shift, Reflector& reflector) {
  for (int m = end - 2;; --m) {
    const double z = at(m, m), r = shift.x - z, s = shift.y - z;
    reflector = {(r * s - shift.w) / at(m + 1, m) + at(m, m + 1), at(m + 1, m + 1) - z - r - s,
                 at(m + 2, m + 1)};
    const double size = std::abs(reflector.p) + std::abs(reflector.q) + std::abs(reflector.r);
    reflector = {reflector.p / size, reflector.q / size, reflector.r / size};
    if (m == first) return m;
    const double lost = std::abs(at(m, m - 1)) * (std::abs(reflector.q) + std::abs(reflector.r));
    const double kept = std::abs(reflector.p) *
                        (std::abs(at(m - 1, m - 1)) + std::abs(z) + std::abs(at(m + 1, m + 1)));
    if (lost <= rounding * kept) return m;
  }
}

void Hessenberg::reflect(int first, int k, int end, const Reflector& reflector, double s) {
  const bool three = k != end - 1;
  const double p = reflector.p + s;
  const double x = p / s, y = reflector.q / s, z = reflector.r / s;
  const double q = reflector.q / p, r = reflector.r / p;
  for (int j = k; j <= end; ++j) {
    const double sum = at(k, j) + q * at(k + 1, j) + (three ? r * at(k + 2, j) : 0.0);
    at(k, j) -= sum * x;
    at(k + 1, j) -= sum * y;
    if (three) at(k + 2, j) -= sum * z;
  }
  for (int i = first; i <= std::min(end, k + 3); ++i) {
    const double sum = x * at(i, k) + y * at(i, k + 1) + (three ? z * at(i, k + 2) : 0.0);
    at(i, k) -= sum;
    at(i, k + 1) -= sum * q;
    if (three) at(i, k + 2) -= sum * r;
  }
}

/// One QR double step over the block from `first` to `end`.
void Hessenberg::double_step(int first, int end, const Shift& shift) {
  Reflector reflector;
  const int start = start_of_step(first, end, shift, reflector);
  for (int i = start + 2; i <= end; ++i) {
    at(i, i - 2) = 0.0;
    if (i != start + 2) at(i, i - 3) = 0.0;
  }
  for (int k = start; k < end; ++k) {
    double size = 1.0;
    if (k != start) {
      reflector = {at(k, k - 1), at(k + 1, k - 1), k != end - 1 ? at(k + 2, k - 1) : 0.0};
      size = std::abs(reflector.p) + std::abs(reflector.q) + std::abs(reflector.r);
      if (size != 0.0) reflector = {reflector.p / size, reflector.q / size, reflector.r / size};
    }
    const double s = std::copysign(std::sqrt(reflector.p * reflector.p + reflector.q * reflector.q +
                                             reflector.r * reflector.r),
                                   reflector.p);
    if (s == 0.0) continue;
    if (k != start) {
      at(k, k - 1) = -s * size;
    } else if (first != start) {
      at(k, k - 1) = -at(k, k - 1);
    }
    reflect(first, k, end, reflector, s);
  }
}

/// Adds the real parts of the 2x2 block that ends at `end`.
void Hessenberg::add_pair(int end) {
  const Shift block = shift_of(end);
  const double p = 0.5 * (block.y - block.x), square = p * p + block.w;
  const double x = block.x + shifted_;
  if (square < 0.0) {
    found_.add(x + p);
    found_.add(x + p);
    return;
  }
  const double z = p + std::copysign(std::sqrt(square), p);
  found_.add(x + z);
  found_.add(z != 0.0 ? x - block.w / z : x + z);
}

/// A shift for when the usual one makes no progress; the constants are those of Martin, Peters and
/// Wilkinson.
Hessenberg::Shift Hessenberg::exceptional_shift(int end) {
  const double x = at(end, end);
  shifted_ += x;
  for (int i = 0; i <= end; ++i) at(i, i) -= x;
  const double size = std::abs(at(end, end - 1)) + std::abs(at(end - 1, end - 2));
  return {0.75 * size, 0.75 * size, -0.4375 * size * size};
}

RealParts Hessenberg::eigenvalues() {
  constexpr int sweeps_max = 200, exceptional_every = 10;  // three are usual
  const double whole = norm();
  int sweeps = 0;
  for (int end = size_ - 1; end >= 0 && sweeps < sweeps_max;) {
    const int first = block_start(end, whole);
    if (first < end - 1) {
      const bool exceptional = sweeps > 0 && sweeps % exceptional_every == 0;
      double_step(first, end, exceptional ? exceptional_shift(end) : shift_of(end));
      ++sweeps;
      continue;
    }
    if (first == end) {
      found_.add(at(end, end) + shifted_);
    } else {
      add_pair(end);
    }
    end = first - 1;
    sweeps = 0;
  }
  return found_;
}

}  // namespace

RealParts real_parts_of_roots(const Polynomial& g, double negligible) {
  double largest = 0.0;
  for (const double coefficient : g) largest = std::max(largest, std::abs(coefficient));
  const auto coefficient = [&g](int k) { return g[static_cast<std::size_t>(k)]; };
  int degree = degree_max;
  while (degree > 0 && !(std::abs(coefficient(degree)) > negligible * largest)) --degree;
  if (degree == 0 || !std::isfinite(largest)) return {};
  Hessenberg companion(degree);
  for (int k = 0; k < degree; ++k) {
    if (k > 0) companion.at(k, k - 1) = 1.0;
    companion.at(k, degree - 1) = -coefficient(k) / coefficient(degree);
  }
  companion.balance();
  return companion.eigenvalues();
}

}  // namespace gazed::triangulation::methods
