#include "agent/geometry/cholesky.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace gazed::geometry::cholesky_test {
namespace {

constexpr double rounding = 1e-12;

Eigen::MatrixXd random_covariance(Eigen::Index size, std::mt19937& bits) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(size, size + 1, [&] { return normal(bits); });
  return root.lazyProduct(root.transpose());
}

TEST(Cholesky, SolvesAndInverts) {
  std::mt19937 bits(1);
  for (Eigen::Index size = 1; size <= 46; size += 9) {
    const Eigen::MatrixXd matrix = random_covariance(size, bits);
    Eigen::MatrixXd l = matrix;
    ASSERT_TRUE(factorise(l));
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(size, size);
    solve_factorised(l, inverse);
    const double scale = matrix.norm() * inverse.norm();
    EXPECT_LT((matrix.lazyProduct(inverse) - Eigen::MatrixXd::Identity(size, size)).norm(),
              rounding * scale)
        << size;
    Eigen::VectorXd x = matrix.col(0);
    solve_factorised(l, x);
    EXPECT_LT((x - Eigen::VectorXd::Unit(size, 0)).norm(), rounding * scale) << size;
    invert_factorised(l);
    EXPECT_LT((l - inverse).norm(), rounding * scale * inverse.norm()) << size;
  }
}

TEST(Cholesky, TakesAPartAndReadsTheLowerTriangleAlone) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Constant(std::numeric_limits<double>::quiet_NaN());
  matrix.block<2, 2>(1, 2) << 4.0, std::numeric_limits<double>::quiet_NaN(), 2.0, 5.0;
  ASSERT_TRUE(factorise(matrix.block<2, 2>(1, 2)));
  EXPECT_EQ(matrix(1, 2), 2.0);
  EXPECT_EQ(matrix(2, 2), 1.0);
  EXPECT_EQ(matrix(2, 3), 2.0);
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefinite) {
  for (const double last : {1.0, 0.5, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Eigen::Matrix2d matrix{{1.0, 1.0}, {1.0, last}};
    EXPECT_FALSE(factorise(matrix)) << last;
  }
}

TEST(Cholesky, WhitensACovariance) {
  const Eigen::Matrix2d covariance{{4.0, 1.0}, {1.0, 2.0}};
  const Eigen::Matrix2d w = whitening(covariance);
  EXPECT_LT((w * covariance * w.transpose() - Eigen::Matrix2d::Identity()).norm(), rounding);
}

}  // namespace
}  // namespace gazed::geometry::cholesky_test
