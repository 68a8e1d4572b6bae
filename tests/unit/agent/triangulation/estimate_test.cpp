#include "agent/triangulation/estimate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "agent/geometry/chain.hpp"

#include "estimates.hpp"
#include "golden.hpp"
#include "random.hpp"

namespace gazed::triangulation::estimate_test {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

TEST(Estimate, LocatedWithEverythingFilled) {
  const Vector3d truth_m(0.35, 0.02, 0.15);
  const Fixture fixture(truth_m);
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::located) << out.reason;
  expect_filled(out, Filled::position);
  constexpr double rounding_m = 1e-12;
  EXPECT_LT((out.torso_point_m - truth_m).norm(), rounding_m);
  EXPECT_LT(
      (geometry::cam_from_torso(fixture.rig.head, fixture.looks.head_1) * truth_m - out.point_m)
          .norm(),
      rounding_m);
  EXPECT_NEAR(out.range_m, out.point_m.norm(), rounding_m);
  EXPECT_NEAR(out.range_m * out.inverse_range_per_m, 1.0, rounding_m);
  EXPECT_NEAR(out.range_sigma_m, out.range_m * out.range_m * out.inverse_range_sigma_per_m,
              rounding_m);
  EXPECT_LT(out.residual_px, 1e-9);
  EXPECT_GT(out.torso_covariance_m2.trace(), out.covariance_m2.trace())
      << "the torso's holds the errors of where camera 1 is";
  EXPECT_THAT(out.reason, HasSubstr("within the gate of 15 %"));
}

TEST(Estimate, RangeSigmaIsTheCovarianceAlongTheRay) {
  const PointEstimate out = Fixture().estimate();
  const Vector3d ray = out.point_m.normalized();
  EXPECT_NEAR(std::sqrt(ray.dot(out.covariance_m2 * ray)), out.range_sigma_m, 1e-12);
}

TEST(Estimate, UncertainByTheGateKeepsItsPosition) {
  Fixture fixture({1.2, 0.02, 0.15});
  fixture.gate.relative_sigma_max = 0.05;
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::uncertain);
  expect_filled(out, Filled::position);
  EXPECT_TRUE(out.torso_covariance_m2.allFinite());
  EXPECT_THAT(out.reason, HasSubstr("over the gate of 5 %"));
}

TEST(Estimate, UncertainWhenInfinityIsWithinOneSigma) {
  Fixture fixture({60.0, 0.02, 0.15});
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::uncertain);
  expect_filled(out, Filled::inverse_range);
  EXPECT_TRUE(out.torso_point_m.array().isNaN().all());
  EXPECT_TRUE(out.torso_covariance_m2.array().isNaN().all());
  EXPECT_THAT(out.reason, HasSubstr("may be at infinity"));
}

/// Rays that diverge by so many of the sigmas that a point at infinity would show.
PointEstimate diverging(double sigmas) {
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0.0, 0.0)};
  constexpr double focal_px = 600.0, sigma_px = 0.5;
  const double disparity = -sigmas * std::sqrt(2.0) * sigma_px / focal_px;
  return estimate_point({.cam2_from_cam1 = sideways,
                         .point_1 = undistorted_point({0.0, 0.0}, focal_px, sigma_px),
                         .point_2 = undistorted_point({-disparity, 0.0}, focal_px, sigma_px),
                         .torso_from_cam1 = {}},
                        {}, {});
}

TEST(Estimate, SlightlyDivergingRaysAreUncertainClearlyDivergingOnesBehind) {
  EXPECT_EQ(diverging(0.9).status, Status::uncertain);
  expect_filled(diverging(0.9), Filled::inverse_range);
  EXPECT_LT(diverging(0.9).inverse_range_per_m, 0.0);
  EXPECT_EQ(diverging(1.1).status, Status::behind_camera);
  expect_filled(diverging(1.1), Filled::inverse_range);
  EXPECT_THAT(diverging(3.0).reason, HasSubstr("3.0 sigmas below 0"));
}

/// Rays that converge by so many sigmas of their disparity.
PointEstimate converging(double sigmas) {
  return diverging(-sigmas);
}

TEST(Estimate, APositionBeginsWhereInfinityIsMoreThanOneSigmaAway) {
  expect_filled(converging(0.99), Filled::inverse_range);
  EXPECT_EQ(converging(0.99).status, Status::uncertain);
  expect_filled(converging(1.01), Filled::position);
  EXPECT_EQ(converging(1.01).status, Status::uncertain);
}

TEST(Estimate, LocatedEndsWhereTheGateIs) {
  EXPECT_EQ(converging(1.01 / 0.15).status, Status::located);
  EXPECT_EQ(converging(0.99 / 0.15).status, Status::uncertain);
}

/// A camera whose baseline is so many sigmas of an error of its pose, or whose two rays are so many
/// sigmas of their pixels off the baseline.
PointEstimate with_baseline_of(double sigmas) {
  constexpr double focal_px = 600.0, sigma_px = 0.5, sigma_m = 0.01;
  const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-sigmas * sigma_m, 0.0, 0.0)};
  ErrorSources errors;
  ErrorSource along;
  along.cam2_from_cam1.translation_m = Vector3d(sigma_m, 0.0, 0.0);
  errors.add(along);
  return estimate_point({.cam2_from_cam1 = sideways,
                         .point_1 = undistorted_point({0.1, 0.0}, focal_px, sigma_px),
                         .point_2 = undistorted_point({-0.1, 0.0}, focal_px, sigma_px),
                         .torso_from_cam1 = {}},
                        errors, {});
}

PointEstimate with_rays_off_the_baseline_by(double sigmas) {
  constexpr double focal_px = 600.0, sigma_px = 0.5;
  const geometry::Pose forward{Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, -0.1)};
  const double off = sigmas * sigma_px / focal_px;
  return estimate_point({.cam2_from_cam1 = forward,
                         .point_1 = undistorted_point({0.9 * off, 0.0}, focal_px, sigma_px),
                         .point_2 = undistorted_point({off, 0.0}, focal_px, sigma_px),
                         .torso_from_cam1 = {}},
                        {}, {});
}

TEST(Estimate, DegenerateEndsThreeSigmasFromNothing) {
  EXPECT_EQ(with_baseline_of(2.99).status, Status::degenerate);
  EXPECT_NE(with_baseline_of(3.01).status, Status::degenerate);
  EXPECT_EQ(with_rays_off_the_baseline_by(2.99).status, Status::degenerate);
  EXPECT_NE(with_rays_off_the_baseline_by(3.01).status, Status::degenerate);
}

TEST(Estimate, DegenerateWhenTheHeadDidNotMove) {
  Fixture fixture;
  fixture.looks.head_2 = fixture.looks.head_1;
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::degenerate);
  expect_filled(out, Filled::nothing);
  EXPECT_TRUE(out.torso_point_m.array().isNaN().all());
}

TEST(Estimate, DegenerateWhenTheMoveIsNoiseOfTheEncoders) {
  Fixture fixture({0.35, 0.02, 0.15}, {0.0, 0.1}, {0.02, 0.1});
  EXPECT_NE(fixture.estimate().status, Status::degenerate) << "1 mrad encoders can tell 20 mrad";
  fixture.rig.uncertainty.encoder_sigma_rad = 0.01;
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::degenerate);
  EXPECT_THAT(out.reason, HasSubstr("within 3.0 sigmas of none"));
}

TEST(Estimate, TargetLostWhenTheCorrespondenceIsWrong) {
  Fixture fixture;
  fixture.looks.pixel_2.y() += 25.0;  // the move is mostly sideways: across the epipolar line
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::target_lost);
  expect_filled(out, Filled::residual);
  EXPECT_GT(out.residual_px, 5.0);
  EXPECT_THAT(out.reason, HasSubstr(" px, "));
  EXPECT_THAT(out.reason, HasSubstr(" sigmas"));
}

TEST(Estimate, TheSameResidualIsToleratedWhenTheAnglesAreKnownToBeBad) {
  Fixture fixture;
  fixture.looks.pixel_2.y() += 25.0;
  fixture.rig.uncertainty.encoder_sigma_rad = 0.02;
  EXPECT_NE(fixture.estimate().status, Status::target_lost);
}

TEST(Estimate, NoSigmaAtAllStillAnswers) {
  Fixture fixture;
  fixture.rig.uncertainty = {};
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::located) << out.reason;
  EXPECT_EQ(out.inverse_range_sigma_per_m, 0.0);
}

class Swapped : public testing::TestWithParam<methods::Method> {};

INSTANTIATE_TEST_SUITE_P(Methods, Swapped, testing::ValuesIn(methods::all_methods),
                         [](const auto& case_info) {
                           std::string out(name(case_info.param));
                           std::replace(out.begin(), out.end(), '-', '_');
                           return out;
                         });

/// Rectification keeps camera 1's ray and linear MMSE's prior is in camera 1's frame: these are
/// held to it on exact image points only, the prior wide.
TEST_P(Swapped, ViewsGiveTheSamePoint) {
  const bool exact =
      GetParam() == methods::Method::rectification || GetParam() == methods::Method::linear_mmse;
  // The prior's pull at 1e-3 of its information; Lindstrom's cost is within 1e-6 of the least.
  const double tolerance_m = GetParam() == methods::Method::optimal ? 1e-9 : 1e-5;
  const methods::Prior wide{.mean_m = {0.0, 0.0, 0.8}, .sigma_m = Vector3d::Constant(1e3)};
  const Gate gate{.relative_sigma_max = 1.0, .epipolar_chi2_max = 100.0, .baseline_sigmas = 3.0};
  Random random(12);
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    const geometry::Pose pose{
        geometry::about_y(random.uniform(-0.3, 0.3)) * geometry::about_x(random.uniform(-0.2, 0.2)),
        0.1 * random.normal_3()};
    const Vector3d point_m(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.8);
    const auto seen = [&](const Vector3d& in_cam_m) {
      const Eigen::Vector2d noise = random.normal_2() / 752.0;
      return undistorted_point(in_cam_m.hnormalized() + (exact ? 0.0 : 1.0) * noise, 752.0, 1.0);
    };
    const ImagePoint point_1 = seen(point_m);
    const ImagePoint point_2 = seen(pose * point_m);
    const PointEstimate forth =
        estimate_point({pose, point_1, point_2, {}}, {}, gate, GetParam(), wide);
    const PointEstimate back =
        estimate_point({pose.inverse(), point_2, point_1, {}}, {}, gate, GetParam(), wide);
    if (!forth.point_m.allFinite() || !back.point_m.allFinite()) continue;
    ++compared;
    EXPECT_LT((pose * forth.point_m - back.point_m).norm(), tolerance_m * (1.0 + point_m.norm()));
    EXPECT_NEAR(forth.residual_px, back.residual_px, tolerance_m);
    EXPECT_NEAR(forth.parallax_rad, back.parallax_rad, tolerance_m);
  }
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace gazed::triangulation::estimate_test
