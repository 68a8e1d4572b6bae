#include "agent/geometry/pose.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "agent/geometry/chain.hpp"

namespace gazed::geometry::pose_test {
namespace {

// Products of a few rotation matrices round at about 1e-16 an entry.
constexpr double rounding = 1e-14;

constexpr double quarter_turn_rad = std::numbers::pi / 2.0;

const Pose b_from_a{about_z(0.3) * about_y(-0.7), {0.1, -0.2, 0.3}};
const Pose c_from_b{about_x(1.1), {-1.0, 0.5, 2.0}};
const Eigen::Vector3d x_in_a{0.4, 0.5, -0.6};

TEST(Rotation, QuarterTurnsTakeEachAxisToTheNext) {
  using Eigen::Vector3d;
  EXPECT_TRUE((about_x(quarter_turn_rad) * Vector3d::UnitY()).isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE((about_y(quarter_turn_rad) * Vector3d::UnitZ()).isApprox(Vector3d::UnitX()));
  EXPECT_TRUE((about_z(quarter_turn_rad) * Vector3d::UnitX()).isApprox(Vector3d::UnitY()));
}

TEST(Rotation, IsOrthonormalAndRightHanded) {
  for (const Eigen::Matrix3d& r : {about_x(0.8), about_y(-2.0), about_z(3.1)}) {
    EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding);
    EXPECT_NEAR(r.determinant(), 1.0, rounding);
  }
}

TEST(Rotation, BetweenDirectionsIsTheSmallest) {
  using Eigen::Vector3d;
  const Vector3d from(0.3, -2.0, 1.5), axis = from.unitOrthogonal();
  for (const double angle_rad : {0.0, 1e-9, 0.1, 1.5, 3.0, std::numbers::pi - 1e-7}) {
    const Vector3d to = 0.7 * (std::cos(angle_rad) * from + std::sin(angle_rad) * axis.cross(from));
    const Eigen::Matrix3d r = rotation_between(from, to);
    // What rounding leaves of the direction of a sum of nearly opposite ones.
    const double leverage = 1.0 / std::cos(0.5 * angle_rad);
    EXPECT_LT((r * from.normalized() - to.normalized()).norm(), rounding * leverage) << angle_rad;
    EXPECT_LT((r * axis - axis).norm(), rounding * leverage) << angle_rad;
    EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding) << angle_rad;
    EXPECT_NEAR(r.determinant(), 1.0, rounding) << angle_rad;
  }
}

TEST(Rotation, BetweenOppositeDirectionsIsAHalfTurn) {
  const Eigen::Vector3d from(0.3, -2.0, 1.5);
  const Eigen::Matrix3d r = rotation_between(from, -from);
  EXPECT_LT((r * from + from).norm(), rounding * from.norm());
  EXPECT_NEAR(r.trace(), -1.0, rounding);
  EXPECT_NEAR(r.determinant(), 1.0, rounding);
}

TEST(Rotation, BetweenNearlyOppositeDirectionsIsAHalfTurn) {
  constexpr double root_of_rounding = 2e-8;  // where a half turn and the general case err alike
  const Eigen::Vector3d from(0.3, -2.0, 1.5), axis = from.unitOrthogonal();
  for (const double short_of_rad : {1e-12, 1e-11, 1e-10, 1e-9, 1e-8}) {
    const Eigen::Vector3d to = -from + short_of_rad * axis.cross(from);
    const Eigen::Matrix3d r = rotation_between(from, to);
    EXPECT_LT((r * from.normalized() - to.normalized()).norm(), root_of_rounding) << short_of_rad;
    EXPECT_NEAR(r.determinant(), 1.0, rounding) << short_of_rad;
  }
}

TEST(Pose, ComposesInTheOrderItIsRead) {
  const Pose c_from_a = c_from_b * b_from_a;
  EXPECT_LT((c_from_a * x_in_a - c_from_b * (b_from_a * x_in_a)).norm(), rounding);
}

TEST(Pose, InverseUndoesIt) {
  EXPECT_LT((b_from_a.inverse() * (b_from_a * x_in_a) - x_in_a).norm(), rounding);
}

TEST(Pose, OriginIsWhereTheFrameStands) {
  const Eigen::Vector3d b_in_a = origin(b_from_a);
  EXPECT_LT((b_from_a * b_in_a).norm(), rounding);
  EXPECT_LT((b_in_a - b_from_a.inverse().translation).norm(), rounding);
}

}  // namespace
}  // namespace gazed::geometry::pose_test
