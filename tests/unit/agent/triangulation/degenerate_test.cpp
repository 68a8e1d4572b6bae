// Configurations without an answer, by name, for every method.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "agent/triangulation/estimate.hpp"
#include "agent/triangulation/methods/rectification.hpp"

#include "estimates.hpp"
#include "golden.hpp"
#include "method_name.hpp"
#include "problems.hpp"

namespace gazed::triangulation::degenerate_test {
namespace {

using Eigen::Vector3d;

TwoViews views_of(const DegenerateCase& c) {
  // degenerate.json: f 752 px, sigma 0.5 px, no angle sigma, gate 15 %.
  return {.cam2_from_cam1 = c.cam2_from_cam1,
          .point_1 = undistorted_point(c.normalised_1, 752.0, 0.5),
          .point_2 = undistorted_point(c.normalised_2, 752.0, 0.5),
          .torso_from_cam1 = {}};
}

PointEstimate estimate(const DegenerateCase& c) {
  return estimate_point(views_of(c), {}, {});
}

class Degenerate : public testing::TestWithParam<methods::Method> {};

INSTANTIATE_TEST_SUITE_P(Methods, Degenerate, testing::ValuesIn(methods::all_methods), method_name);

TEST_P(Degenerate, EveryGoldenCaseGetsItsStatus) {
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
    const PointEstimate out = estimate_point(views_of(c), {}, {}, GetParam());
    // Straight ahead there is nothing to rectify, whatever the images show.
    const bool forward = c.name.starts_with("5 px from epipole");
    const auto& [status, filled] = GetParam() == methods::Method::rectification && forward
                                       ? std::pair(Status::degenerate, Filled::nothing)
                                       : status_of_class.at(c.expected_class);
    EXPECT_EQ(name(out.status), name(status)) << out.reason;
    expect_filled(out, filled);
  }
}

constexpr double focal_px = 752.0, sigma_px = 0.5;

PointEstimate estimate_sideways(methods::Method method, const Eigen::Vector2d& point_1,
                                const Eigen::Vector2d& point_2,
                                const geometry::Pose& cam2_from_cam1) {
  return estimate_point({.cam2_from_cam1 = cam2_from_cam1,
                         .point_1 = undistorted_point(point_1, focal_px, sigma_px),
                         .point_2 = undistorted_point(point_2, focal_px, sigma_px),
                         .torso_from_cam1 = {}},
                        {}, {}, method);
}

const geometry::Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0.0, 0.0)};
const geometry::Pose oblique{Eigen::Matrix3d::Identity(), Vector3d(-0.05, 0.0, -0.1)};

TEST_P(Degenerate, NanAfterAGoodPointIsNotThatPoint) {
  ASSERT_EQ(estimate_sideways(GetParam(), {0.1, 0.05}, {0.0, 0.05}, sideways).status,
            Status::located);
  const PointEstimate out =
      estimate_sideways(GetParam(), {not_a_number, 0.05}, {0.0, 0.05}, sideways);
  EXPECT_EQ(out.status, Status::invalid_input);
  expect_filled(out, Filled::nothing);
}

TEST_P(Degenerate, ZeroBaseline) {
  const PointEstimate out =
      estimate_sideways(GetParam(), {0.1, 0.05}, {0.0, 0.05}, geometry::Pose{});
  EXPECT_EQ(out.status, Status::degenerate);
  expect_filled(out, Filled::nothing);
}

TEST_P(Degenerate, OnTheBaseline) {
  const Eigen::Vector2d epipole = oblique.translation.hnormalized();
  const PointEstimate out = estimate_sideways(GetParam(), epipole, epipole, oblique);
  EXPECT_EQ(out.status, Status::degenerate);
  expect_filled(out, Filled::nothing);
}

TEST_P(Degenerate, OnePointAtItsEpipole) {
  const Eigen::Vector2d epipole = oblique.translation.hnormalized();
  const Eigen::Vector2d elsewhere = epipole + Eigen::Vector2d(0.2, 0.0);
  for (const auto& [point_1, point_2] :
       {std::pair(epipole, elsewhere), std::pair(elsewhere, epipole)}) {
    const PointEstimate out = estimate_sideways(GetParam(), point_1, point_2, oblique);
    EXPECT_EQ(out.status, Status::degenerate) << out.reason;
    expect_filled(out, Filled::nothing);
  }
}

TEST_P(Degenerate, ParallelRays) {
  const PointEstimate out = estimate_sideways(GetParam(), {0.1, 0.05}, {0.1, 0.05}, sideways);
  EXPECT_EQ(out.status, Status::uncertain);
  expect_filled(out, Filled::inverse_range);
}

TEST_P(Degenerate, BehindBothCameras) {
  const PointEstimate out = estimate_sideways(GetParam(), {0.1, 0.05}, {0.2, 0.05}, sideways);
  EXPECT_EQ(out.status, Status::behind_camera);
  expect_filled(out, Filled::inverse_range);
}

TEST_P(Degenerate, BehindCamera2Only) {
  // 0.8 m ahead of camera 1, camera 2 is 1 m ahead.
  const geometry::Pose forward{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0.0, -1.0)};
  const Vector3d point_m(0.2, 0.1, 0.8);
  const PointEstimate out = estimate_sideways(GetParam(), point_m.hnormalized(),
                                              (forward * point_m).hnormalized(), forward);
  EXPECT_EQ(out.status, Status::behind_camera) << out.reason;
  expect_filled(out, Filled::inverse_range);
}

TEST_P(Degenerate, NotTheSamePoint) {
  const PointEstimate out = estimate_sideways(GetParam(), {0.1, 0.05}, {0.0, 0.08}, sideways);
  EXPECT_EQ(out.status, Status::target_lost);
  expect_filled(out, Filled::residual);
}

/// True points in front of and behind the cameras, seen without error: what must come out is known.
TEST_P(Degenerate, ExactPointsNeverGetAWrongStatus) {
  constexpr int problems = GAZED_RANDOM_PROBLEMS / 4;  // times four geometries
  const auto is_hard_to_rectify = [](const geometry::Pose& pose, const Vector3d& in_cam2_m) {
    if (GetParam() != methods::Method::rectification) return false;
    // A ray along the rectified image plane: any noise moves its image there by as much as it
    // likes.
    constexpr double least_slope = 0.02;
    const Vector3d ray = methods::rectify(pose)->rectified_from_cam2 * in_cam2_m.normalized();
    return std::abs(ray.z()) < least_slope;
  };
  constexpr double noise_px = 1e-3;
  Random random(8);
  std::map<std::string_view, int> wrong;
  for (int i = 0; i < problems; ++i) {
    for (const Geometry geometry : geometries) {
      const geometry::Pose pose = random_pose(geometry, random);
      const Vector3d point_m(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4),
                             random.uniform(-1.5, 1.5));
      const Vector3d in_cam2_m = pose * point_m;
      if (pose.translation.norm() < 2e-3 || std::abs(point_m.z()) < 0.05 ||
          std::abs(in_cam2_m.z()) < 0.05) {
        continue;
      }
      const PointEstimate out =
          estimate_point({.cam2_from_cam1 = pose,
                          .point_1 = undistorted_point(point_m.hnormalized(), focal_px, noise_px),
                          .point_2 = undistorted_point(in_cam2_m.hnormalized(), focal_px, noise_px),
                          .torso_from_cam1 = {}},
                         {}, {}, GetParam());
      // Near the baseline the noise decides, however small.
      constexpr double least_sine = 0.02;
      const double sine = point_m.cross(geometry::origin(pose)).norm() / point_m.norm() /
                          geometry::origin(pose).norm();
      if (sine < least_sine) continue;
      const bool in_front = point_m.z() > 0.0 && in_cam2_m.z() > 0.0;
      const bool right = out.status == (in_front ? Status::located : Status::behind_camera) ||
                         (out.status == Status::uncertain && is_hard_to_rectify(pose, in_cam2_m));
      if (!right) ++wrong[name(out.status)];
    }
  }
  for (const auto& [status, count] : wrong) ADD_FAILURE() << count << " times wrongly " << status;
}

/// Scene points in front of both cameras, seen with noise: nothing is half filled, nothing is not a
/// number where there is one, and hardly any is called another point.
TEST_P(Degenerate, NoisyPointsAreWhollyFilledAndRarelyLost) {
  constexpr int problems = GAZED_RANDOM_PROBLEMS / 4;  // times four geometries
  Random random(9);
  int lost = 0, half_filled = 0;
  for (int i = 0; i < problems; ++i) {
    for (const Geometry geometry : geometries) {
      const Problem problem = random_problem(geometry, random);
      const double noise_px = geometry == Geometry::noisy ? 8.0 : 1.0;
      const PointEstimate out =
          estimate_point({.cam2_from_cam1 = problem.cam2_from_cam1,
                          .point_1 = undistorted_point(problem.point_1, focal_px, noise_px),
                          .point_2 = undistorted_point(problem.point_2, focal_px, noise_px),
                          .torso_from_cam1 = geometry::Pose{}},
                         {}, {}, GetParam());
      lost += out.status == Status::target_lost ? 1 : 0;
      const bool position = out.torso_point_m.allFinite() && out.torso_covariance_m2.allFinite() &&
                            out.point_m.allFinite() && out.covariance_m2.allFinite() &&
                            std::isfinite(out.range_m + out.range_sigma_m) && out.range_m > 0.0;
      const bool interval = std::isfinite(out.inverse_range_per_m) &&
                            out.inverse_range_sigma_per_m > 0.0 &&
                            std::isfinite(out.residual_px + out.parallax_rad);
      const bool right = out.status == Status::located         ? position && interval
                         : out.status == Status::uncertain     ? interval
                         : out.status == Status::behind_camera ? interval && !position
                                                               : !interval && !position;
      half_filled += right ? 0 : 1;
    }
  }
  EXPECT_EQ(half_filled, 0);
  // 99.9 % of chi-square; beside the epipole, where 8 px are far, the first order is not all.
  EXPECT_LE(lost, 0.002 * 4 * problems);
}

// Numbers from the file's own notes ("why").
TEST(GoldenNumbers, OfTheDegenerateCases) {
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

}  // namespace
}  // namespace gazed::triangulation::degenerate_test
