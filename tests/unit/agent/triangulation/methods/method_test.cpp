#include "agent/triangulation/methods/method.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "agent/geometry/chain.hpp"
#include "agent/triangulation/methods/linear_mmse.hpp"
#include "agent/triangulation/methods/rectification.hpp"

#include "tests/unit/agent/triangulation/golden.hpp"
#include "tests/unit/agent/triangulation/problems.hpp"

namespace gazed::triangulation::methods::method_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

// Positions to 1e-9 of the distance, image points to 1e-9 px (agent/README.md).
constexpr double golden_point = 1e-9;
constexpr double golden_pixel_px = 1e-9;

TEST(Method, NamesAndBack) {
  EXPECT_EQ(name(Method::optimal), "optimal");
  EXPECT_EQ(name(Method::rectification), "rectification");
  EXPECT_EQ(name(Method::linear_mmse), "linear-mmse");
  EXPECT_EQ(name(Method::lindstrom), "lindstrom");
  for (const Method method : all_methods) EXPECT_EQ(method_of(name(method)), method);
  EXPECT_FALSE(method_of("Optimal"));
  EXPECT_FALSE(method_of(""));
}

TEST(Rectification, Golden) {
  const geometry::CameraModel camera = golden_camera();
  for (const GoldenMethods& golden : golden_methods()) {
    SCOPED_TRACE(golden.name);
    const auto rectification = rectify(golden.cam2_from_cam1);
    ASSERT_TRUE(rectification);
    const Vector2d point_1 = *geometry::normalise(camera, golden.pixel_1);
    const Vector2d point_2 = *geometry::normalise(camera, golden.pixel_2);
    const auto rectified = [&](const Eigen::Matrix3d& axes, const Vector2d& point) {
      return geometry::pixel_of(camera, (axes * point.homogeneous()).hnormalized());
    };
    EXPECT_LT((rectified(rectification->rectified_from_cam1, point_1) - golden.rectified_1).norm(),
              golden_pixel_px);
    EXPECT_LT((rectified(rectification->rectified_from_cam2, point_2) - golden.rectified_2).norm(),
              golden_pixel_px);
    const auto solved = solve(Method::rectification, golden.cam2_from_cam1, point_1, point_2);
    ASSERT_TRUE(solved);
    EXPECT_LT((solved->point_m() - golden.rectification_m).norm(),
              golden_point * golden.rectification_m.norm());
  }
}

TEST(Rectification, AxesAreARotationOfBothCameras) {
  constexpr double rounding = 1e-14;
  Random random(1);
  for (const Geometry geometry : geometries) {
    for (int i = 0; i < 200; ++i) {
      const geometry::Pose pose = random_pose(geometry, random);
      const auto rectification = rectify(pose);
      ASSERT_TRUE(rectification);
      for (const Eigen::Matrix3d& axes :
           {rectification->rectified_from_cam1, rectification->rectified_from_cam2}) {
        EXPECT_LT((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding);
        EXPECT_GT(axes.determinant(), 0.0);
      }
      const Vector3d centre_2 = rectification->rectified_from_cam1 * geometry::origin(pose);
      EXPECT_LT((centre_2 - Vector3d(rectification->baseline_m, 0, 0)).norm(), rounding);
    }
  }
}

TEST(Rectification, NoneForABaselineAlongTheOpticalAxis) {
  EXPECT_FALSE(rectify({geometry::about_y(0.2), geometry::about_y(0.2) * Vector3d(0, 0, -0.1)}));
  EXPECT_FALSE(rectify(geometry::Pose{}));
}

TEST(LinearMmse, Golden) {
  const geometry::CameraModel camera = golden_camera();
  for (const GoldenMethods& golden : golden_methods()) {
    SCOPED_TRACE(golden.name);
    const Vector2d point_1 = *geometry::normalise(camera, golden.pixel_1);
    const Vector2d point_2 = *geometry::normalise(camera, golden.pixel_2);
    const auto estimate = estimate_linear_mmse(golden.cam2_from_cam1, point_1, point_2, {});
    ASSERT_TRUE(estimate);
    EXPECT_LT((estimate->point_m - golden.mmse_m).norm(), golden_point * golden.mmse_m.norm());
    EXPECT_LT((estimate->covariance_m2 - golden.mmse_covariance_m2).norm(),
              golden_point * golden.mmse_covariance_m2.norm());
  }
}

TEST(LinearMmse, ItsCovarianceIsThatOfTheImagesAndThePriorTogether) {
  constexpr double rounding = 1e-9;  // relative
  const geometry::Pose pose{geometry::about_y(-0.2), Vector3d(-0.05, 0.01, 0.0)};
  MmseModel model;
  model.noise_1 << 4e-6, 1e-6, 1e-6, 3e-6;
  model.noise_2 << 9e-6, -2e-6, -2e-6, 5e-6;
  const auto estimate = estimate_linear_mmse(pose, {0.1, 0.05}, {0.2, 0.05}, model);
  ASSERT_TRUE(estimate);
  Eigen::Matrix4d noise = Eigen::Matrix4d::Zero();
  noise.topLeftCorner<2, 2>() = model.noise_1;
  noise.bottomRightCorner<2, 2>() = model.noise_2;
  const Eigen::Matrix3d sum =
      estimate->by_image_points_m * noise * estimate->by_image_points_m.transpose() +
      estimate->by_prior_m * estimate->by_prior_m.transpose();
  EXPECT_LT((sum - estimate->covariance_m2).norm(), rounding * estimate->covariance_m2.norm());
}

TEST(LinearMmse, ATightPriorIsBelievedAndAWideOneIsNot) {
  const geometry::Pose pose{Eigen::Matrix3d::Identity(), Vector3d(-0.05, 0.0, 0.0)};
  const Vector3d seen_m(0.02, 0.01, 0.5);
  MmseModel model;
  model.prior.sigma_m.setConstant(1e-6);
  const auto tight =
      estimate_linear_mmse(pose, seen_m.hnormalized(), (pose * seen_m).hnormalized(), model);
  ASSERT_TRUE(tight);
  EXPECT_LT((tight->point_m - model.prior.mean_m).norm(), 1e-3);
  model.prior.sigma_m.setConstant(1e6);
  const auto wide =
      estimate_linear_mmse(pose, seen_m.hnormalized(), (pose * seen_m).hnormalized(), model);
  ASSERT_TRUE(wide);
  EXPECT_LT((wide->point_m - seen_m).norm(), 1e-9);
}

/// Summed squared distances of a solution's two images to what was measured.
double cost(const Problem& problem, const geometry::InverseDepthPoint& point) {
  const geometry::Pose& pose = problem.cam2_from_cam1;
  const Vector3d in_cam2 =
      pose.rotation * point.direction.homogeneous() + point.inverse_depth_per_m * pose.translation;
  return (point.direction - problem.point_1).squaredNorm() +
         (in_cam2.hnormalized() - problem.point_2).squaredNorm();
}

class Methods : public testing::TestWithParam<Geometry> {};

INSTANTIATE_TEST_SUITE_P(Geometries, Methods, testing::ValuesIn(geometries),
                         [](const auto& case_info) { return geometry_name(case_info.param); });

TEST_P(Methods, NoneIsCheaperThanOptimal) {
  constexpr double rounding = 1e-9;  // relative: of the point's reprojection
  Random random(44);
  for (int i = 0; i < 5000; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const auto with = [&problem](Method method) {
      const auto point = solve(method, problem.cam2_from_cam1, problem.point_1, problem.point_2);
      return point ? cost(problem, *point) : std::numeric_limits<double>::infinity();
    };
    const double optimal = with(Method::optimal);
    for (const Method method : all_methods) {
      EXPECT_LE(optimal, with(method) * (1.0 + rounding) + 1e-20) << name(method) << " " << i;
    }
  }
}

TEST_P(Methods, AllAreExactOnExactPoints) {
  constexpr double tolerance = 1e-9;  // normalised units: the prior's pull at 1e-9 of noise is less
  Random random(45);
  MmseModel sharp;
  sharp.noise_1 = sharp.noise_2 = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 2000; ++i) {
    const Problem noisy = random_problem(GetParam(), random);
    const geometry::Pose& pose = noisy.cam2_from_cam1;
    const double depth_m = random.uniform(0.3, 2.0);
    const Vector3d truth_m = depth_m * noisy.point_1.homogeneous();
    const Vector3d in_cam2_m = pose * truth_m;
    const double sine = truth_m.cross(geometry::origin(pose)).norm() / truth_m.norm() /
                        geometry::origin(pose).norm();
    if (in_cam2_m.z() < 0.1 || sine < 0.1) continue;
    const Problem exact{pose, truth_m.hnormalized(), in_cam2_m.hnormalized()};
    for (const Method method : all_methods) {
      const auto point = solve(method, pose, exact.point_1, exact.point_2, sharp);
      ASSERT_TRUE(point) << name(method);
      EXPECT_LT(std::sqrt(cost(exact, *point)), tolerance) << name(method) << " " << i;
      EXPECT_NEAR(point->inverse_depth_per_m * depth_m, 1.0, 1e-4) << name(method) << " " << i;
    }
  }
}

TEST(Solve, NothingForNanAndZeroBaseline) {
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  for (const Method method : all_methods) {
    SCOPED_TRACE(name(method));
    EXPECT_TRUE(solve(method, sideways, {0.1, 0.05}, {0.0, 0.05}));
    EXPECT_FALSE(solve(method, sideways, {not_a_number, 0.05}, {0.0, 0.05}));
    EXPECT_FALSE(solve(method, sideways, {0.1, 0.05}, {0.0, not_a_number}));
    EXPECT_FALSE(solve(method, geometry::Pose{}, {0.1, 0.05}, {0.0, 0.05}));
  }
}

}  // namespace
}  // namespace gazed::triangulation::methods::method_test
