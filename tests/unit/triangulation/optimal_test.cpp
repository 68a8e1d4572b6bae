#include "agent/triangulation/optimal.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/epipolar.hpp"
#include "agent/geometry/head.hpp"

#include "golden.hpp"
#include "random.hpp"

namespace gazed {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double focal_px = 752.0;

// Golden tolerances: DESIGN 2, "the same located points to 1e-9".
constexpr double golden_pixel_px = 1e-9;
constexpr double golden_cost_px2 = 1e-9;
constexpr double golden_point = 1e-9;  // of the distance

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, CorrectedPointsCostAndPosition) {
  const GoldenCase& golden = GetParam();
  SCOPED_TRACE(golden.name);
  const CameraModel camera = golden_camera();
  const auto pair = correct_optimally(golden.cam2_from_cam1, *normalise(camera, golden.pixel_1),
                                      *normalise(camera, golden.pixel_2));
  ASSERT_TRUE(pair);
  EXPECT_LT((pixel_of(camera, pair->point_1) - golden.corrected_1).norm(), golden_pixel_px);
  EXPECT_LT((pixel_of(camera, pair->point_2) - golden.corrected_2).norm(), golden_pixel_px);
  EXPECT_NEAR(focal_px * focal_px * pair->cost, golden.cost_px2, golden_cost_px2);
  const InverseDepthPoint point = intersect(golden.cam2_from_cam1, *pair);
  const Vector3d point_m = point.direction.homogeneous() / point.inverse_depth_per_m;
  EXPECT_LT((point_m - golden.point_m).norm(), golden_point * golden.point_m.norm());
}

INSTANTIATE_TEST_SUITE_P(ReportGeometry, Golden, testing::ValuesIn(golden_cases()),
                         [](const auto& case_info) { return std::to_string(case_info.index); });

struct Problem {
  Pose cam2_from_cam1;
  Vector2d point_1, point_2;
};

enum class Geometry { head_turn, forward, general, noisy };
constexpr std::array geometries{Geometry::head_turn, Geometry::forward, Geometry::general,
                                Geometry::noisy};

std::string geometry_name(Geometry geometry) {
  switch (geometry) {
    case Geometry::head_turn:
      return "HeadTurn";
    case Geometry::forward:
      return "ForwardWithTheEpipoleInView";
    case Geometry::general:
      return "General";
    case Geometry::noisy:
      break;
  }
  return "EightPixelNoise";
}

Pose random_pose(Geometry geometry, Random& random) {
  const auto angle = [&](double most) { return random.uniform(-most, most); };
  if (geometry == Geometry::head_turn || geometry == Geometry::noisy) {
    HeadGeometry head;
    head.mount_offset_m = {0.05871, 0.0, 0.06364};
    const HeadAngles first{angle(1.0), angle(0.4)};
    return cam2_from_cam1(head, first, first + HeadAngles{angle(0.7), angle(0.4)});
  }
  const Eigen::Matrix3d rotation =
      rotation_x(angle(0.3)) * rotation_y(angle(0.3)) * rotation_z(angle(0.3));
  if (geometry == Geometry::forward) {
    return {rotation_x(angle(0.02)) * rotation_y(angle(0.02)),
            Vector3d(angle(0.01), angle(0.01), -random.uniform(0.05, 0.2))};
  }
  return {rotation, Vector3d(angle(0.3), angle(0.3), angle(0.3))};
}

/// A scene point in front of both cameras, seen with noise.
Problem random_problem(Geometry geometry, Random& random) {
  const double noise = (geometry == Geometry::noisy ? 8.0 : 1.0) / focal_px;
  for (;;) {
    const Pose pose = random_pose(geometry, random);
    const double depth_m = random.uniform(0.25, 3.0);
    const Vector3d x1(depth_m * random.uniform(-0.4, 0.4), depth_m * random.uniform(-0.3, 0.3),
                      depth_m);
    const Vector3d x2 = pose * x1;
    if (x2.z() < 0.05 || pose.translation.norm() < 1e-3) continue;
    return {pose, x1.hnormalized() + noise * random.normal_2(),
            x2.hnormalized() + noise * random.normal_2()};
  }
}

/// The same minimum by brute force, sharing no formula with the polynomial: the summed squared
/// distances to the epipolar lines of the plane at `angle` about the baseline.
class PencilOfPlanes {
 public:
  explicit PencilOfPlanes(const Problem& problem) : problem_(problem) {
    const Pose& pose = problem.cam2_from_cam1;
    const Vector3d baseline = pose.rotation.transpose() * pose.translation;
    first_ = baseline.unitOrthogonal();
    second_ = baseline.normalized().cross(first_);
  }

  double cost(double angle) const {
    const Vector3d normal = std::cos(angle) * first_ + std::sin(angle) * second_;
    return squared_distance(normal, problem_.point_1) +
           squared_distance(problem_.cam2_from_cam1.rotation * normal, problem_.point_2);
  }

  double least_cost() const {
    // The planes through the two measured points are included: the minimum can be a narrow valley
    // beside either of them when a point is close to its epipole.
    constexpr int samples = 2000;
    constexpr double spacing = std::numbers::pi / samples;
    std::vector<double> starts;
    for (int i = 0; i < samples; ++i) {
      const double here = cost(i * spacing);
      if (here <= cost((i - 1) * spacing) && here <= cost((i + 1) * spacing)) {
        starts.push_back(i * spacing);
      }
    }
    double least = std::numeric_limits<double>::infinity();
    for (const double start : starts) least = std::min(least, refined(start, spacing));
    const Pose& pose = problem_.cam2_from_cam1;
    for (const Vector3d& ray :
         {Vector3d(problem_.point_1.homogeneous()),
          Vector3d(pose.rotation.transpose() * problem_.point_2.homogeneous())}) {
      const double angle = std::atan2(-first_.dot(ray), second_.dot(ray));
      for (double width = spacing; width > 1e-12; width *= 0.3) {
        least = std::min(least, refined(angle, width));
      }
    }
    return least;
  }

 private:
  static double squared_distance(const Vector3d& line, const Vector2d& point) {
    const double at = line.dot(point.homogeneous());
    return at * at / line.head<2>().squaredNorm();
  }

  /// Golden section search.
  double refined(double middle, double half_width) const {
    constexpr double ratio = std::numbers::phi - 1.0;
    double low = middle - half_width, high = middle + half_width;
    double left = high - ratio * (high - low), right = low + ratio * (high - low);
    double cost_left = cost(left), cost_right = cost(right);
    for (int i = 0; i < 60; ++i) {
      if (cost_left < cost_right) {
        high = right;
        right = left;
        cost_right = cost_left;
        left = high - ratio * (high - low);
        cost_left = cost(left);
      } else {
        low = left;
        left = right;
        cost_left = cost_right;
        right = low + ratio * (high - low);
        cost_right = cost(right);
      }
    }
    return std::min(cost_left, cost_right);
  }

  Problem problem_;
  Vector3d first_, second_;
};

class Optimal : public testing::TestWithParam<Geometry> {};

INSTANTIATE_TEST_SUITE_P(Geometries, Optimal, testing::ValuesIn(geometries),
                         [](const auto& case_info) { return geometry_name(case_info.param); });

TEST_P(Optimal, NoOtherEpipolarPlaneIsCheaper) {
  // The cost's own rounding is far below; golden section stops at the square root of epsilon.
  constexpr double relative_excess = 1e-6;
  constexpr double cost_rounding = 1e-24;  // normalised units squared: the square of 1e-12
  Random random(20110901);
  for (int i = 0; i < 1500; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const auto pair = correct_optimally(problem.cam2_from_cam1, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const double least = PencilOfPlanes(problem).least_cost();
    EXPECT_LE(pair->cost, least * (1.0 + relative_excess) + cost_rounding) << "problem " << i;
    EXPECT_GE(pair->cost, least * (1.0 - relative_excess) - cost_rounding) << "problem " << i;
  }
}

TEST_P(Optimal, CorrectedPointsAreConsistentAndCostWhatIsSaid) {
  constexpr double rounding = 1e-13;
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const Pose& pose = problem.cam2_from_cam1;
    const auto pair = correct_optimally(pose, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const Eigen::Matrix3d e = essential_matrix(pose).normalized();
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
    const InverseDepthPoint point = intersect(problem.cam2_from_cam1, *pair);
    const Vector3d in_cam2 = problem.cam2_from_cam1.rotation * point.direction.homogeneous() +
                             point.inverse_depth_per_m * problem.cam2_from_cam1.translation;
    EXPECT_LT((in_cam2.hnormalized() - pair->point_2).norm(), tolerance) << "problem " << i;
  }
}

TEST(OptimalDegenerate, PerfectPointsAreLeftAlone) {
  const Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const auto pair = correct_optimally(sideways, {0.1, 0.05}, {0.0, 0.05});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->cost, 0.0);
  EXPECT_EQ(pair->point_1, Vector2d(0.1, 0.05));
  EXPECT_EQ(pair->point_2, Vector2d(0.0, 0.05));
}

TEST(OptimalDegenerate, PureSidewaysMotionSharesTheErrorEqually) {
  // Epipoles at infinity: f1 = f2 = 0, the polynomial is linear, both rows meet half way.
  const Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const auto pair = correct_optimally(sideways, {0.1, 0.05}, {0.0, 0.052});
  ASSERT_TRUE(pair);
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(pair->point_1.y(), 0.051, rounding);
  EXPECT_NEAR(pair->point_2.y(), 0.051, rounding);
  EXPECT_NEAR(pair->cost, 2e-6, rounding);
}

TEST(OptimalDegenerate, NearlySidewaysMotionToo) {
  for (const double forward : {1e-18, 1e-15, 1e-12, 1e-9, 1e-6}) {
    const Pose pose{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, forward)};
    const auto pair = correct_optimally(pose, {0.1, 0.05}, {0.0, 0.052});
    ASSERT_TRUE(pair);
    EXPECT_NEAR(pair->point_1.y(), 0.051, 1e-6 * 0.1 + forward * 10.0) << forward;
  }
}

TEST(OptimalDegenerate, ZeroBaselineIsRefused) {
  EXPECT_FALSE(correct_optimally(Pose{}, {0.1, 0.05}, {0.1, 0.05}));
}

TEST(OptimalDegenerate, APointAtItsEpipoleIsRefused) {
  const Pose forward{Eigen::Matrix3d::Identity(), Vector3d(0, 0, -0.1)};
  EXPECT_FALSE(correct_optimally(forward, {0.0, 0.0}, {0.1, 0.0}));
  EXPECT_FALSE(correct_optimally(forward, {0.1, 0.0}, {0.0, 0.0}));
}

TEST(OptimalDegenerate, NanIsRefused) {
  const Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  EXPECT_FALSE(correct_optimally(sideways, {std::nan(""), 0.0}, {0.1, 0.0}));
  EXPECT_FALSE(correct_optimally(sideways, {0.1, 0.0}, {0.1, std::nan("")}));
}

/// Points so close to the epipoles that the best line may be the one at infinity of the pencil, and
/// so far from agreeing that the polynomial has six real roots.
TEST(OptimalDegenerate, AroundTheEpipolesTheGlobalMinimumIsFound) {
  constexpr double relative_excess = 1e-6;
  constexpr double rounding =
      1e-12;  // of a distance: that of the epipole (1e-16) on a lever of 1e4
  Random random(31);
  for (int i = 0; i < 3000; ++i) {
    const Pose pose = random_pose(Geometry::forward, random);
    const Vector2d epipole_1 = (pose.rotation.transpose() * pose.translation).hnormalized();
    const Vector2d epipole_2 = pose.translation.hnormalized();
    const double spread_1 = std::pow(10.0, random.uniform(-6.0, -1.0));
    const double spread_2 = std::pow(10.0, random.uniform(-6.0, -1.0));
    const Problem problem{pose, epipole_1 + spread_1 * random.normal_2(),
                          epipole_2 + spread_2 * random.normal_2()};
    const auto pair = correct_optimally(pose, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const double least = PencilOfPlanes(problem).least_cost();
    EXPECT_LE(std::sqrt(pair->cost), std::sqrt(least) * (1.0 + relative_excess) + rounding)
        << "problem " << i;
  }
}

TEST(Intersect, ParallelRaysMeetAtInfinity) {
  const Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const InverseDepthPoint point = intersect(sideways, {{0.1, 0.05}, {0.1, 0.05}, 0.0});
  EXPECT_EQ(point.inverse_depth_per_m, 0.0);
}

TEST(Intersect, DivergingRaysMeetBehind) {
  const Pose sideways{Eigen::Matrix3d::Identity(), Vector3d(-0.1, 0, 0)};
  const InverseDepthPoint point = intersect(sideways, {{0.1, 0.05}, {0.3, 0.05}, 0.0});
  EXPECT_NEAR(point.inverse_depth_per_m, -2.0, 1e-14);  // 0.2 of disparity over 0.1 m
}

}  // namespace
}  // namespace gazed
