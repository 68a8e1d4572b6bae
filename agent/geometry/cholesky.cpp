#include "agent/geometry/cholesky.hpp"

#include <cmath>

namespace gazed::geometry {

using Eigen::Index;

bool factorise(Eigen::Ref<Eigen::MatrixXd> matrix) {
  const Index size = matrix.rows();
  for (Index j = 0; j < size; ++j) {
    double* const column = &matrix(0, j);
    if (!(column[j] > 0.0)) return false;
    const double root = std::sqrt(column[j]);
    column[j] = root;
    for (Index i = j + 1; i < size; ++i) column[i] /= root;
    for (Index k = j + 1; k < size; ++k) {
      double* const later = &matrix(0, k);
      const double factor = column[k];
      for (Index i = k; i < size; ++i) later[i] -= factor * column[i];
    }
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

Eigen::Matrix2d whitening(const Eigen::Matrix2d& covariance) {
  const double xx = std::sqrt(covariance(0, 0)), yx = covariance(1, 0) / xx;
  const double yy = std::sqrt(covariance(1, 1) - yx * yx);
  const double scale = 1.0 / (xx * yy);
  return Eigen::Matrix2d{{yy * scale, 0.0}, {-yx * scale, xx * scale}};
}

}  // namespace gazed::geometry
