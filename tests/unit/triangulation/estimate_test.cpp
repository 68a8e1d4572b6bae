#include "agent/triangulation/estimate.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "golden.hpp"
#include "random.hpp"

namespace gazed {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::HasSubstr;

/// What is filled under each status, apart from the numbers' values.
enum class Filled { nothing, residual, inverse_range, position };

void expect_filled(const PointEstimate& estimate, Filled filled) {
  EXPECT_EQ(std::isfinite(estimate.residual_px), filled >= Filled::residual);
  EXPECT_EQ(std::isfinite(estimate.parallax_rad), filled >= Filled::residual);
  EXPECT_EQ(std::isfinite(estimate.inverse_range_per_m), filled >= Filled::inverse_range);
  EXPECT_EQ(std::isfinite(estimate.inverse_range_sigma_per_m), filled >= Filled::inverse_range);
  const bool position = filled >= Filled::position;
  EXPECT_EQ(estimate.point_m.allFinite(), position);
  EXPECT_EQ(estimate.covariance_m2.allFinite(), position);
  EXPECT_EQ(std::isfinite(estimate.range_m), position);
  EXPECT_EQ(std::isfinite(estimate.range_sigma_m), position);
  // All or nothing: no half-filled vector.
  EXPECT_EQ(estimate.point_m.array().isNaN().any(), !position);
  EXPECT_EQ(estimate.covariance_m2.array().isNaN().all(), !position);
  EXPECT_FALSE(estimate.reason.empty());
}

PointEstimate estimate(const DegenerateCase& c) {
  // degenerate.json: f 752 px, sigma 0.5 px, no angle sigma, gate 15 % (DESIGN 4.2).
  return estimate_point({.cam2_from_cam1 = c.cam2_from_cam1,
                         .point_1 = undistorted_point(c.normalised_1, 752.0, 0.5),
                         .point_2 = undistorted_point(c.normalised_2, 752.0, 0.5),
                         .torso_from_cam1 = {}},
                        {}, {});
}

TEST(Degenerate, EveryGoldenCaseGetsItsStatus) {
  const std::map<std::string, std::pair<Status, Filled>> status_of_class{
      {"OK", {Status::located, Filled::position}},
      {"ZERO_BASELINE", {Status::degenerate, Filled::nothing}},
      {"ON_BASELINE", {Status::degenerate, Filled::nothing}},
      {"AT_INFINITY", {Status::uncertain, Filled::inverse_range}},
      {"LOW_CONFIDENCE", {Status::uncertain, Filled::position}},
      {"BEHIND", {Status::behind_camera, Filled::inverse_range}},
      {"NON_FINITE", {Status::invalid_input, Filled::nothing}}};
  const auto cases = degenerate_cases();
  ASSERT_EQ(cases.size(), 16U);
  for (const DegenerateCase& c : cases) {
    SCOPED_TRACE(c.name);
    const PointEstimate out = estimate(c);
    const auto& [status, filled] = status_of_class.at(c.expected_class);
    EXPECT_EQ(name(out.status), name(status)) << out.reason;
    expect_filled(out, filled);
  }
}

DegenerateCase degenerate_case(const std::string& name) {
  for (DegenerateCase& c : degenerate_cases()) {
    if (c.name == name) return c;
  }
  throw std::runtime_error("no case " + name);
}

// Numbers from the file's own notes ("why").
TEST(Degenerate, NumbersOfTheGoldenCases) {
  constexpr double noted_to = 5e-4;  // three or four digits are noted
  const auto z = [](const std::string& name) {
    return estimate(degenerate_case(name)).point_m.z();
  };
  EXPECT_NEAR(z("NAO 0.1 rad 0.3 m exact"), 0.3, 1e-12);
  EXPECT_NEAR(z("NAO 0.1 rad 0.3 m +1px"), 0.2810, noted_to);
  EXPECT_NEAR(z("NAO 0.1 rad 0.3 m -1px"), 0.3218, noted_to);
  const PointEstimate exact = estimate(degenerate_case("NAO 0.1 rad 0.3 m exact"));
  EXPECT_NEAR(exact.inverse_range_sigma_per_m / exact.inverse_range_per_m, 0.048, noted_to);
  EXPECT_NEAR(1.0 / estimate(degenerate_case("diverging -5 px")).inverse_range_per_m, -15.13, 0.01);
  EXPECT_NEAR(1.0 / estimate(degenerate_case("behind both")).inverse_range_per_m,
              -Vector3d(0.1, 0.05, 0.5).norm(), 1e-12);
  EXPECT_EQ(estimate(degenerate_case("parallel rays (infinity)")).inverse_range_per_m, 0.0);
}

/// A NAO V6 as delivered, well calibrated, that looks at a point from two sides.
struct Fixture {
  RobotProfile robot = robot_profile("nao-v6").value();
  Gate gate;
  TwoLooks looks;

  explicit Fixture(const Vector3d& torso_point_m = {0.35, 0.02, 0.15},
                   HeadAngles head_1 = {0.2, 0.1}, HeadAngles head_2 = {-0.3, 0.3}) {
    robot.uncertainty = {.pixel_sigma_px = 0.3,
                         .encoder_sigma_rad = 1e-3,
                         .zero_sigma_rad = 3e-3,
                         .focal_sigma_px = 0.5,
                         .centre_sigma_px = 1.0,
                         .mount_offset_sigma_m = 1e-3,
                         .mount_rotation_sigma_rad = 3e-3};
    looks.head_1 = head_1;
    looks.head_2 = head_2;
    looks.pixel_1 =
        project(robot.camera, cam_from_torso(robot.head, head_1) * torso_point_m).value();
    looks.pixel_2 =
        project(robot.camera, cam_from_torso(robot.head, head_2) * torso_point_m).value();
  }

  [[nodiscard]] PointEstimate estimate() const {
    return estimate_point(robot.head, robot.camera, robot.uncertainty, looks, gate);
  }
};

TEST(Estimate, LocatedWithEverythingFilled) {
  const Vector3d truth_m(0.35, 0.02, 0.15);
  const Fixture fixture(truth_m);
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::located) << out.reason;
  expect_filled(out, Filled::position);
  constexpr double rounding_m = 1e-12;
  EXPECT_LT((out.torso_point_m - truth_m).norm(), rounding_m);
  EXPECT_LT(
      (cam_from_torso(fixture.robot.head, fixture.looks.head_1) * truth_m - out.point_m).norm(),
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
  const Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0.0, 0.0)};
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
  fixture.robot.uncertainty.encoder_sigma_rad = 0.01;
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
  fixture.robot.uncertainty.encoder_sigma_rad = 0.02;
  EXPECT_NE(fixture.estimate().status, Status::target_lost);
}

TEST(Estimate, NoSigmaAtAllStillAnswers) {
  Fixture fixture;
  fixture.robot.uncertainty = {};
  const PointEstimate out = fixture.estimate();
  EXPECT_EQ(out.status, Status::located) << out.reason;
  EXPECT_EQ(out.inverse_range_sigma_per_m, 0.0);
}

TEST(Estimate, SwappingTheViewsGivesTheSamePoint) {
  constexpr double tolerance_m = 1e-9;
  Random random(12);
  for (int i = 0; i < 500; ++i) {
    const Pose pose{rotation_y(random.uniform(-0.3, 0.3)) * rotation_x(random.uniform(-0.2, 0.2)),
                    0.1 * random.normal_3()};
    const Vector3d point_m(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.8);
    const ImagePoint point_1 =
        undistorted_point(point_m.hnormalized() + random.normal_2() / 752.0, 752.0, 1.0);
    const ImagePoint point_2 =
        undistorted_point((pose * point_m).hnormalized() + random.normal_2() / 752.0, 752.0, 1.0);
    const Gate gate{.relative_sigma_max = 1.0, .epipolar_chi2_max = 100.0, .baseline_sigmas = 3.0};
    const PointEstimate forth = estimate_point({pose, point_1, point_2, {}}, {}, gate);
    const PointEstimate back = estimate_point({pose.inverse(), point_2, point_1, {}}, {}, gate);
    if (!forth.point_m.allFinite() || !back.point_m.allFinite()) continue;
    EXPECT_LT((pose * forth.point_m - back.point_m).norm(), tolerance_m * (1.0 + point_m.norm()));
    EXPECT_NEAR(forth.residual_px, back.residual_px, tolerance_m);
    EXPECT_NEAR(forth.parallax_rad, back.parallax_rad, tolerance_m);
  }
}

TEST(InvalidInput, NanAndInfinityInEachInput) {
  using Change = std::function<void(Fixture&, double)>;
  const std::vector<std::pair<std::string, Change>> changes{
      {"pixel_1.x", [](Fixture& f, double v) { f.looks.pixel_1.x() = v; }},
      {"pixel_1.y", [](Fixture& f, double v) { f.looks.pixel_1.y() = v; }},
      {"pixel_2.x", [](Fixture& f, double v) { f.looks.pixel_2.x() = v; }},
      {"pixel_2.y", [](Fixture& f, double v) { f.looks.pixel_2.y() = v; }},
      {"covariance xx", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(0, 0) = v; }},
      {"covariance xy", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(0, 1) = v; }},
      {"covariance yx", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(1, 0) = v; }},
      {"covariance yy", [](Fixture& f, double v) { f.looks.pixel_2_covariance_px2(1, 1) = v; }},
      {"yaw 1", [](Fixture& f, double v) { f.looks.head_1.yaw_rad = v; }},
      {"pitch 1", [](Fixture& f, double v) { f.looks.head_1.pitch_rad = v; }},
      {"yaw 2", [](Fixture& f, double v) { f.looks.head_2.yaw_rad = v; }},
      {"pitch 2", [](Fixture& f, double v) { f.looks.head_2.pitch_rad = v; }},
      {"zero", [](Fixture& f, double v) { f.robot.head.zero.pitch_rad = v; }},
      {"neck", [](Fixture& f, double v) { f.robot.head.neck_offset_m.z() = v; }},
      {"mount offset", [](Fixture& f, double v) { f.robot.head.mount_offset_m.x() = v; }},
      {"mount rotation", [](Fixture& f, double v) { f.robot.head.mount_rotation_rad.z() = v; }},
      {"focal", [](Fixture& f, double v) { f.robot.camera.focal_px.y() = v; }},
      {"centre", [](Fixture& f, double v) { f.robot.camera.centre_px.x() = v; }},
      {"distortion", [](Fixture& f, double v) { f.robot.camera.distortion[1] = v; }},
      {"pixel sigma", [](Fixture& f, double v) { f.robot.uncertainty.pixel_sigma_px = v; }},
      {"encoder sigma", [](Fixture& f, double v) { f.robot.uncertainty.encoder_sigma_rad = v; }},
      {"zero sigma", [](Fixture& f, double v) { f.robot.uncertainty.zero_sigma_rad = v; }},
      {"focal sigma", [](Fixture& f, double v) { f.robot.uncertainty.focal_sigma_px = v; }},
      {"centre sigma", [](Fixture& f, double v) { f.robot.uncertainty.centre_sigma_px = v; }},
      {"offset sigma", [](Fixture& f, double v) { f.robot.uncertainty.mount_offset_sigma_m = v; }},
      {"rotation sigma",
       [](Fixture& f, double v) { f.robot.uncertainty.mount_rotation_sigma_rad = v; }},
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [input, change] : changes) {
    for (const double value : {not_a_number, infinity, -infinity}) {
      SCOPED_TRACE(input + " = " + std::to_string(value));
      ASSERT_EQ(Fixture().estimate().status, Status::located);  // a point that must not come back
      Fixture fixture;
      change(fixture, value);
      const PointEstimate out = fixture.estimate();
      EXPECT_EQ(out.status, Status::invalid_input) << out.reason;
      expect_filled(out, Filled::nothing);
      EXPECT_TRUE(out.torso_point_m.array().isNaN().all());
    }
  }
}

TEST(InvalidInput, NanInTheGate) {
  for (double Gate::*limit :
       {&Gate::relative_sigma_max, &Gate::epipolar_chi2_max, &Gate::baseline_sigmas}) {
    Fixture fixture;
    fixture.gate.*limit = not_a_number;
    EXPECT_EQ(fixture.estimate().status, Status::invalid_input);
  }
}

TEST(InvalidInput, ACameraWithoutAFocalLength) {
  Fixture fixture;
  fixture.robot.camera.focal_px.setZero();
  EXPECT_EQ(fixture.estimate().status, Status::invalid_input);
}

TEST(InvalidInput, ANegativeSigmaOrACovarianceThatIsNone) {
  Fixture negative;
  negative.robot.uncertainty.encoder_sigma_rad = -1e-3;
  EXPECT_EQ(negative.estimate().status, Status::invalid_input);
  Fixture indefinite;
  indefinite.looks.pixel_2_covariance_px2 << 1.0, 2.0, 2.0, 1.0;
  EXPECT_EQ(indefinite.estimate().status, Status::invalid_input);
}

TEST(InvalidInput, AnyNumbersWhatsoeverGetAnAnswer) {
  Random random(77);
  const auto wild = [&random] {
    const double magnitude = std::pow(10.0, random.uniform(-320.0, 308.0));
    return random.uniform() < 0.5 ? magnitude : -magnitude;
  };
  for (int i = 0; i < 20'000; ++i) {
    Fixture fixture;
    TwoLooks& looks = fixture.looks;
    for (double* value : {&looks.pixel_1.x(), &looks.pixel_1.y(), &looks.pixel_2.x(),
                          &looks.pixel_2.y(), &looks.head_1.yaw_rad, &looks.head_1.pitch_rad,
                          &looks.head_2.yaw_rad, &looks.head_2.pitch_rad}) {
      if (random.uniform() < 0.3) *value = wild();
    }
    const PointEstimate out = fixture.estimate();
    EXPECT_FALSE(out.reason.empty());
    if (out.status == Status::located) {
      EXPECT_TRUE(out.torso_point_m.allFinite() && out.torso_covariance_m2.allFinite());
      EXPECT_GT(out.range_m, 0.0);
    }
  }
}

}  // namespace
}  // namespace gazed
