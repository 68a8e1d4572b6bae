#include "agent/geometry/cholesky.hpp"

#include <cmath>

namespace gazed::geometry {

using Eigen::Index;

namespace {

constexpr Index unrolled = 4;  // columns that are taken off at once: memory is slower than sums

struct Span {
  Index begin, end;
};

/// Adds the columns of a span to column `j`, in some rows, each times `sign` and what it has in row
/// `j`.
void add_columns(Eigen::Ref<Eigen::MatrixXd> matrix, Index j, Span columns, Span rows,
                 double sign) {
  double* const column = &matrix(0, j);
  Index k = columns.begin;
  for (; k + unrolled <= columns.end; k += unrolled) {
    const double* const a = &matrix(0, k);
    const double* const b = &matrix(0, k + 1);
    const double* const c = &matrix(0, k + 2);
    const double* const d = &matrix(0, k + 3);
    const double of_a = sign * a[j], of_b = sign * b[j], of_c = sign * c[j], of_d = sign * d[j];
    for (Index i = rows.begin; i < rows.end; ++i) {
      column[i] = column[i] + of_a * a[i] + of_b * b[i] + of_c * c[i] + of_d * d[i];
    }
  }
  for (; k < columns.end; ++k) {
    const double* const one = &matrix(0, k);
    const double of_one = sign * one[j];
    for (Index i = rows.begin; i < rows.end; ++i) column[i] += of_one * one[i];
  }
}

}  // namespace

bool factorise(Eigen::Ref<Eigen::MatrixXd> matrix) {
  const Index size = matrix.rows();
  for (Index j = 0; j < size; ++j) {
    add_columns(matrix, j, {0, j}, {j, size}, -1.0);
    double* const column = &matrix(0, j);
    if (!(column[j] > 0.0)) return false;
    const double root = std::sqrt(column[j]);
    column[j] = root;
    for (Index i = j + 1; i < size; ++i) column[i] /= root;
  }
  return true;
}

void solve_factorised(const Eigen::Ref<const Eigen::MatrixXd>& l, Eigen::Ref<Eigen::MatrixXd> b) {
  const Index size = l.rows();
  for (Index k = 0; k < b.cols(); ++k) {
    double* const x = &b(0, k);
    for (Index j = 0; j < size; ++j) {
      if (x[j] == 0.0) continue;  // half of a unit matrix
      const double* const column = l.col(j).data();
      x[j] /= column[j];
      for (Index i = j + 1; i < size; ++i) x[i] -= x[j] * column[i];
    }
    for (Index j = size; j-- > 0;) {
      const double* const column = l.col(j).data();
      double rest = x[j];
      for (Index i = j + 1; i < size; ++i) rest -= column[i] * x[i];
      x[j] = rest / column[j];
    }
  }
}

namespace {

/// The inverse of L, in its place.
void invert_triangle(Eigen::Ref<Eigen::MatrixXd> l) {
  const Index size = l.rows();
  for (Index k = 0; k < size; ++k) {
    double* const x = &l(0, k);
    x[k] = 1.0 / x[k];
    for (Index i = k + 1; i < size; ++i) x[i] *= -x[k];
    for (Index j = k + 1; j < size; ++j) {
      const double* const column = &l(0, j);
      x[j] /= column[j];
      for (Index i = j + 1; i < size; ++i) x[i] -= x[j] * column[i];
    }
  }
}

}  // namespace

void invert_factorised(Eigen::Ref<Eigen::MatrixXd> l) {
  invert_triangle(l);
  // With U the transpose of what is there now, the answer is U U^T: of a column above the diagonal
  // the sum of U's columns from that one on, which are still there.
  const Index size = l.rows();
  for (Index j = 0; j < size; ++j) {
    for (Index i = 0; i < j; ++i) l(i, j) = l(j, i);
  }
  for (Index j = 0; j < size; ++j) {
    double* const column = &l(0, j);
    const double own = column[j];
    for (Index i = 0; i <= j; ++i) column[i] *= own;
    add_columns(l, j, {j + 1, size}, {0, j + 1}, 1.0);
  }
  for (Index j = 0; j < size; ++j) {
    for (Index i = 0; i < j; ++i) l(j, i) = l(i, j);
  }
}

Eigen::Matrix2d whitening(const Eigen::Matrix2d& covariance) {
  const double xx = std::sqrt(covariance(0, 0)), yx = covariance(1, 0) / xx;
  const double yy = std::sqrt(covariance(1, 1) - yx * yx);
  const double scale = 1.0 / (xx * yy);
  return Eigen::Matrix2d{{yy * scale, 0.0}, {-yx * scale, xx * scale}};
}

}  // namespace gazed::geometry
