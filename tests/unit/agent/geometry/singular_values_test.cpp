#include "agent/geometry/singular_values.hpp"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace gazed::geometry::singular_values_test {
namespace {

constexpr double rounding = 1e-13;

void expect_decomposed(const Eigen::MatrixXd& matrix) {
  const Eigen::Index size = matrix.cols();
  Eigen::MatrixXd scaled = matrix, v(size, size);
  decompose(scaled, v);
  const double tolerance = rounding * static_cast<double>(size) * matrix.norm();
  EXPECT_LT((scaled.lazyProduct(v.transpose()) - matrix).norm(), tolerance);
  EXPECT_LT((v.transpose().lazyProduct(v) - Eigen::MatrixXd::Identity(size, size)).norm(),
            rounding * static_cast<double>(size));
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      EXPECT_LE(scaled.col(k).norm(), scaled.col(i).norm()) << k << " " << i;
      EXPECT_LT(std::abs(scaled.col(k).dot(scaled.col(i))), tolerance * matrix.norm());
    }
  }
}

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, std::mt19937& bits) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(bits); });
}

TEST(SingularValues, GiveTheMatrixBack) {
  std::mt19937 bits(1);
  for (const Eigen::Index size : {1, 2, 3, 4, 7, 22}) {
    expect_decomposed(random_matrix(size, size, bits));
    expect_decomposed(random_matrix(2 * size, size, bits));
  }
}

TEST(SingularValues, OfMatricesWithoutFullRank) {
  std::mt19937 bits(2);
  expect_decomposed(random_matrix(6, 2, bits).lazyProduct(random_matrix(2, 6, bits)));
  expect_decomposed(Eigen::MatrixXd::Zero(3, 3) + Eigen::MatrixXd::Ones(3, 3));
  Eigen::Matrix3d zero = Eigen::Matrix3d::Zero(), v;
  decompose(zero, v);
  EXPECT_EQ(zero.norm(), 0.0);
  EXPECT_EQ(v, Eigen::Matrix3d::Identity());
}

TEST(SingularValues, OfACovarianceAreItsEigenvalues) {
  Eigen::Matrix2d covariance{{5.0, 2.0}, {2.0, 2.0}}, axes;
  decompose(covariance, axes);
  EXPECT_NEAR(covariance.col(0).norm(), 1.0, rounding);
  EXPECT_NEAR(covariance.col(1).norm(), 6.0, 10.0 * rounding);
  EXPECT_NEAR(std::abs(axes.col(1).dot(Eigen::Vector2d(2.0, 1.0).normalized())), 1.0, rounding);
}

}  // namespace
}  // namespace gazed::geometry::singular_values_test
