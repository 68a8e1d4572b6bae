#include "agent/triangulation/methods/optimal.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/epipolar.hpp"

#include "tests/unit/agent/triangulation/golden.hpp"
#include "tests/unit/agent/triangulation/problems.hpp"

namespace gazed::triangulation::methods::optimal_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double focal_px = 752.0;

// Golden tolerances: located points agree to 1e-9 everywhere (agent/README.md).
constexpr double golden_pixel_px = 1e-9;
constexpr double golden_cost_px2 = 1e-9;
constexpr double golden_point = 1e-9;  // of the distance

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, CorrectedPointsCostAndPosition) {
  const GoldenCase& golden = GetParam();
  SCOPED_TRACE(golden.name);
  const geometry::CameraModel camera = golden_camera();
  const auto pair =
      correct_optimally(golden.cam2_from_cam1, *geometry::normalise(camera, golden.pixel_1),
                        *geometry::normalise(camera, golden.pixel_2));
  ASSERT_TRUE(pair);
  EXPECT_LT((geometry::pixel_of(camera, pair->point_1) - golden.corrected_1).norm(),
            golden_pixel_px);
  EXPECT_LT((geometry::pixel_of(camera, pair->point_2) - golden.corrected_2).norm(),
            golden_pixel_px);
  EXPECT_NEAR(focal_px * focal_px * pair->cost, golden.cost_px2, golden_cost_px2);
  const geometry::InverseDepthPoint point = intersect(golden.cam2_from_cam1, *pair);
  const Vector3d point_m = point.direction.homogeneous() / point.inverse_depth_per_m;
  EXPECT_LT((point_m - golden.point_m).norm(), golden_point * golden.point_m.norm());
}

INSTANTIATE_TEST_SUITE_P(ReportGeometry, Golden, testing::ValuesIn(golden_cases()),
                         [](const auto& case_info) { return std::to_string(case_info.index); });

class Optimal : public testing::TestWithParam<Geometry> {};

INSTANTIATE_TEST_SUITE_P(Geometries, Optimal, testing::ValuesIn(geometries),
                         [](const auto& case_info) { return geometry_name(case_info.param); });

TEST_P(Optimal, CorrectedPointsAreConsistentAndCostWhatIsSaid) {
  constexpr double rounding = 1e-13;
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const geometry::Pose& pose = problem.cam2_from_cam1;
    const auto pair = correct_optimally(pose, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const Eigen::Matrix3d e = geometry::essential_matrix(pose).normalized();
    EXPECT_LT(std::abs(pair->point_2.homogeneous().dot(e * pair->point_1.homogeneous())), rounding);
    const double cost = (pair->point_1 - problem.point_1).squaredNorm() +
                        (pair->point_2 - problem.point_2).squaredNorm();
    EXPECT_NEAR(pair->cost, cost, rounding);
  }
}

TEST_P(Optimal, SwappingTheViewsChangesNothing) {
  constexpr double tolerance = 1e-10;  // normalised units; two different polynomials are solved
  Random random(99);
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const auto pair = correct_optimally(problem.cam2_from_cam1, problem.point_1, problem.point_2);
    const auto swapped =
        correct_optimally(problem.cam2_from_cam1.inverse(), problem.point_2, problem.point_1);
    ASSERT_TRUE(pair && swapped);
    EXPECT_LT((pair->point_1 - swapped->point_2).norm(), tolerance) << "problem " << i;
    EXPECT_LT((pair->point_2 - swapped->point_1).norm(), tolerance) << "problem " << i;
  }
}

TEST_P(Optimal, BothRaysMeetInThePoint) {
  constexpr double tolerance = 1e-9;  // normalised units, for parallaxes down to a milliradian
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const auto pair = correct_optimally(problem.cam2_from_cam1, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const geometry::InverseDepthPoint point = intersect(problem.cam2_from_cam1, *pair);
    const Vector3d in_cam2 = problem.cam2_from_cam1.rotation * point.direction.homogeneous() +
                             point.inverse_depth_per_m * problem.cam2_from_cam1.translation;
    EXPECT_LT((in_cam2.hnormalized() - pair->point_2).norm(), tolerance) << "problem " << i;
  }
}

TEST(OptimalDegenerate, PerfectPointsAreLeftAlone) {
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const auto pair = correct_optimally(sideways, {0.1, 0.05}, {0.0, 0.05});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->cost, 0.0);
  EXPECT_EQ(pair->point_1, Vector2d(0.1, 0.05));
  EXPECT_EQ(pair->point_2, Vector2d(0.0, 0.05));
}

TEST(OptimalDegenerate, PureSidewaysMotionSharesTheErrorEqually) {
  // Epipoles at infinity: f1 = f2 = 0, the polynomial is linear, both rows meet half way.
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const auto pair = correct_optimally(sideways, {0.1, 0.05}, {0.0, 0.052});
  ASSERT_TRUE(pair);
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(pair->point_1.y(), 0.051, rounding);
  EXPECT_NEAR(pair->point_2.y(), 0.051, rounding);
  EXPECT_NEAR(pair->cost, 2e-6, rounding);
}

TEST(OptimalDegenerate, NearlySidewaysMotionToo) {
  for (const double forward : {1e-18, 1e-15, 1e-12, 1e-9, 1e-6}) {
    const geometry::Pose pose{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, forward)};
    const auto pair = correct_optimally(pose, {0.1, 0.05}, {0.0, 0.052});
    ASSERT_TRUE(pair);
    EXPECT_NEAR(pair->point_1.y(), 0.051, 1e-6 * 0.1 + forward * 10.0) << forward;
  }
}

TEST(OptimalDegenerate, ZeroBaselineIsRefused) {
  EXPECT_FALSE(correct_optimally(geometry::Pose{}, {0.1, 0.05}, {0.1, 0.05}));
}

TEST(OptimalDegenerate, APointAtItsEpipoleIsRefused) {
  const geometry::Pose forward{Eigen::Matrix3d::Identity(), Vector3d(0, 0, -0.1)};
  EXPECT_FALSE(correct_optimally(forward, {0.0, 0.0}, {0.1, 0.0}));
  EXPECT_FALSE(correct_optimally(forward, {0.1, 0.0}, {0.0, 0.0}));
}

TEST(OptimalDegenerate, NanIsRefused) {
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  EXPECT_FALSE(correct_optimally(sideways, {std::nan(""), 0.0}, {0.1, 0.0}));
  EXPECT_FALSE(correct_optimally(sideways, {0.1, 0.0}, {0.1, std::nan("")}));
}

TEST(Intersect, ParallelRaysMeetAtInfinity) {
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const geometry::InverseDepthPoint point = intersect(sideways, {{0.1, 0.05}, {0.1, 0.05}, 0.0});
  EXPECT_EQ(point.inverse_depth_per_m, 0.0);
}

TEST(Intersect, DivergingRaysMeetBehind) {
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const geometry::InverseDepthPoint point = intersect(sideways, {{0.1, 0.05}, {0.3, 0.05}, 0.0});
  EXPECT_NEAR(point.inverse_depth_per_m, -2.0, 1e-14);  // 0.2 of disparity over 0.1 m
}

}  // namespace
}  // namespace gazed::triangulation::methods::optimal_test
