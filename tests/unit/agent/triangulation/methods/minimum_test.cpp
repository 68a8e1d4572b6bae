// The optimal method against the minimum found otherwise.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <vector>

#include "agent/geometry/epipolar.hpp"
#include "agent/triangulation/methods/lindstrom.hpp"
#include "agent/triangulation/methods/optimal.hpp"

#include "tests/unit/agent/triangulation/problems.hpp"

namespace gazed::triangulation::methods::minimum_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector4d;

/// The same minimum by brute force, sharing no formula with the polynomial: the summed squared
/// distances to the epipolar lines of the plane at `angle` about the baseline.
class PencilOfPlanes {
 public:
  explicit PencilOfPlanes(const Problem& problem) : problem_(problem) {
    const geometry::Pose& pose = problem.cam2_from_cam1;
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
    const geometry::Pose& pose = problem_.cam2_from_cam1;
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

class Minimum : public testing::TestWithParam<Geometry> {};

INSTANTIATE_TEST_SUITE_P(Geometries, Minimum, testing::ValuesIn(geometries),
                         [](const auto& case_info) { return geometry_name(case_info.param); });

TEST_P(Minimum, NoOtherEpipolarPlaneIsCheaper) {
  // The cost's own rounding is far below; golden section stops at the square root of epsilon.
  constexpr double relative_excess = 1e-6;
  constexpr double cost_rounding = 1e-24;  // normalised units squared: the square of 1e-12
  Random random(20110901);
  for (int i = 0; i < GAZED_RANDOM_PROBLEMS / 64; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const auto pair = correct_optimally(problem.cam2_from_cam1, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const double least = PencilOfPlanes(problem).least_cost();
    EXPECT_LE(pair->cost, least * (1.0 + relative_excess) + cost_rounding) << "problem " << i;
    EXPECT_GE(pair->cost, least * (1.0 - relative_excess) - cost_rounding) << "problem " << i;
  }
}

/// Points so close to the epipoles that the best line may be the one at infinity of the pencil, and
/// so far from agreeing that the polynomial has six real roots.
TEST(Minimum, AroundTheEpipolesTheGlobalMinimumIsFound) {
  constexpr double relative_excess = 1e-6;
  constexpr double rounding =
      1e-12;  // of a distance: that of the epipole (1e-16) on a lever of 1e4
  Random random(31);
  for (int i = 0; i < GAZED_RANDOM_PROBLEMS / 32; ++i) {
    const geometry::Pose pose = random_pose(Geometry::forward, random);
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

/// No pair that fulfils the epipolar constraint costs less than this: the Lagrangian's dual, which
/// for one quadratic constraint reaches the minimum itself (Boyd and Vandenberghe 2004, B.1). No
/// polynomial, no sampling, no starting point: the dual is concave in the one multiplier.
class Dual {
 public:
  explicit Dual(const Problem& problem) {
    const Eigen::Matrix3d e = geometry::essential_matrix(problem.cam2_from_cam1).normalized();
    const Vector3d ray_1 = problem.point_1.homogeneous(), ray_2 = problem.point_2.homogeneous();
    value_ = ray_2.dot(e * ray_1);
    const Vector2d by_point_1 = (e.transpose() * ray_2).head<2>(),
                   by_point_2 = (e * ray_1).head<2>();
    // The curvature, 4x4, is a = e's top left 2x2 and its transpose beside the diagonal: its axes
    // are the pairs (v, u) and (v, -u) of a's singular vectors over the root of 2, of curvature s
    // and -s. a = U(left) diag(s) V(right)' as two rotations, s of either sign.
    const double even = e(0, 0) + e(1, 1), odd = e(0, 0) - e(1, 1);
    const double across = e(1, 0) + e(0, 1), turn = e(1, 0) - e(0, 1);
    const double sum_rad = std::atan2(across, odd), difference_rad = std::atan2(turn, even);
    const double left = 0.5 * (sum_rad + difference_rad), right = 0.5 * (sum_rad - difference_rad);
    const double mean = 0.5 * std::hypot(even, turn), half_range = 0.5 * std::hypot(odd, across);
    const Vector2d along(by_point_1.dot(Vector2d(std::cos(right), std::sin(right))),
                         by_point_2.dot(Vector2d(std::cos(left), std::sin(left))));
    const Vector2d beside(by_point_1.dot(Vector2d(-std::sin(right), std::cos(right))),
                          by_point_2.dot(Vector2d(-std::sin(left), std::cos(left))));
    const double larger = mean + half_range, smaller = mean - half_range;
    curvature_ = {larger, -larger, smaller, -smaller};
    squared_gradient_ = 0.5 * Vector4d(along.x() + along.y(), along.x() - along.y(),
                                       beside.x() + beside.y(), beside.x() - beside.y())
                                  .cwiseAbs2();
  }

  [[nodiscard]] double least_cost() const {
    const double limit = 1.0 / curvature_.maxCoeff();
    double low = -limit, high = limit;
    constexpr int halvings =
        100;  // to 1e-30 of the limit: a multiplier may be as small as the noise
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (slope(middle) > 0.0 ? low : high) = middle;
    }
    return std::max(bound(low), bound(high));
  }

 private:
  [[nodiscard]] double bound(double multiplier) const {
    return 2.0 * multiplier * value_ -
           multiplier * multiplier *
               (squared_gradient_.array() / (1.0 + multiplier * curvature_.array())).sum();
  }
  /// The constraint's value at the minimum of the Lagrangian.
  [[nodiscard]] double slope(double multiplier) const {
    const Eigen::Array4d bent = multiplier * curvature_.array();
    return value_ - multiplier * (squared_gradient_.array() * (1.0 + 0.5 * bent) /
                                  ((1.0 + bent) * (1.0 + bent)))
                                     .sum();
  }

  double value_ = 0.0;
  Vector4d curvature_, squared_gradient_;
};

TEST_P(Minimum, NoneOfAHundredThousandProblemsIsMissed) {
  constexpr int problems = GAZED_RANDOM_PROBLEMS;
  constexpr double relative_excess = 1e-6;
  constexpr double cost_rounding = 1e-24;
  Random random(20110902);
  int missed = 0, missed_by_two_iterations = 0;
  for (int i = 0; i < problems; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const geometry::Pose& pose = problem.cam2_from_cam1;
    const double most = Dual(problem).least_cost() * (1.0 + relative_excess) + cost_rounding;
    const auto optimal = correct_optimally(pose, problem.point_1, problem.point_2);
    missed += optimal && optimal->cost <= most ? 0 : 1;
    const auto fast = correct_in_two_iterations(pose, problem.point_1, problem.point_2);
    missed_by_two_iterations += fast && fast->cost <= most ? 0 : 1;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(missed_by_two_iterations, 0);
}

TEST_P(Minimum, TwoIterationsGiveTheSamePoint) {
  // The cost is flat at its minimum: 1e-6 of it is 1e-3 of a correction, along the surface only.
  constexpr double of_the_correction = 1e-3;
  constexpr double off_the_surface = 1e-6;
  constexpr double rounding = 1e-12;
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const geometry::Pose& pose = problem.cam2_from_cam1;
    const auto optimal = correct_optimally(pose, problem.point_1, problem.point_2);
    const auto fast = correct_in_two_iterations(pose, problem.point_1, problem.point_2);
    ASSERT_TRUE(optimal && fast);
    const double tolerance = of_the_correction * std::sqrt(optimal->cost) + rounding;
    EXPECT_LT((optimal->point_1 - fast->point_1).norm(), tolerance) << "problem " << i;
    EXPECT_LT((optimal->point_2 - fast->point_2).norm(), tolerance) << "problem " << i;
    const Eigen::Matrix3d e = geometry::essential_matrix(pose).normalized();
    EXPECT_LT(std::abs(fast->point_2.homogeneous().dot(e * fast->point_1.homogeneous())),
              off_the_surface * std::sqrt(fast->cost) + rounding);
  }
}

}  // namespace
}  // namespace gazed::triangulation::methods::minimum_test
