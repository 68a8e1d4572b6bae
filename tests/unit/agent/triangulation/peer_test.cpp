// OpenCV's correctMatches, the same method by other hands (Hartley and Sturm 1997), on normalised
// points and a scaled F: with those of pixels it silently degrades.
#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "agent/geometry/epipolar.hpp"
#include "agent/triangulation/methods/optimal.hpp"

#include "problems.hpp"

namespace gazed::triangulation::peer_test {
namespace {

using Eigen::Vector2d;

struct PeerPair {
  Vector2d point_1, point_2;
  double cost = 0.0;
};

PeerPair correct_matches(const Problem& problem) {
  const Eigen::Matrix3d e = geometry::essential_matrix(problem.cam2_from_cam1).normalized();
  cv::Mat f(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) f.at<double>(i, j) = e(i, j);
  }
  const auto as_row = [](const Vector2d& point) {
    cv::Mat row(1, 1, CV_64FC2);
    row.at<cv::Vec2d>(0) = {point.x(), point.y()};
    return row;
  };
  cv::Mat corrected_1, corrected_2;
  cv::correctMatches(f, as_row(problem.point_1), as_row(problem.point_2), corrected_1, corrected_2);
  const auto point_of = [](const cv::Mat& row) {
    return Vector2d(row.at<cv::Vec2d>(0)[0], row.at<cv::Vec2d>(0)[1]);
  };
  PeerPair out{point_of(corrected_1), point_of(corrected_2)};
  out.cost =
      (out.point_1 - problem.point_1).squaredNorm() + (out.point_2 - problem.point_2).squaredNorm();
  return out;
}

class Peer : public testing::TestWithParam<Geometry> {};

INSTANTIATE_TEST_SUITE_P(Geometries, Peer, testing::ValuesIn(geometries),
                         [](const auto& case_info) { return geometry_name(case_info.param); });

TEST_P(Peer, CorrectMatchesAgreesAndIsNeverCheaper) {
  constexpr int problems = 2000;
  constexpr double agreement = 1e-6;      // normalised units: a thousandth of a pixel
  constexpr double cost_rounding = 1e-6;  // relative: what its root finder leaves over
  Random random(61);
  int agree = 0;
  for (int i = 0; i < problems; ++i) {
    const Problem problem = random_problem(GetParam(), random);
    const auto pair =
        methods::correct_optimally(problem.cam2_from_cam1, problem.point_1, problem.point_2);
    ASSERT_TRUE(pair);
    const PeerPair peer = correct_matches(problem);
    if (!peer.point_1.allFinite() || !peer.point_2.allFinite()) continue;
    const bool same = (pair->point_1 - peer.point_1).norm() < agreement &&
                      (pair->point_2 - peer.point_2).norm() < agreement;
    agree += same ? 1 : 0;
    // Where it is elsewhere, its pair costs more, or does not fulfil the constraint.
    const Eigen::Matrix3d e = geometry::essential_matrix(problem.cam2_from_cam1).normalized();
    const double off_surface =
        std::abs(peer.point_2.homogeneous().dot(e * peer.point_1.homogeneous()));
    if (!same && off_surface < 1e-12) {
      EXPECT_GE(peer.cost, pair->cost * (1.0 - cost_rounding)) << "problem " << i;
    }
  }
  RecordProperty("agree", agree);
  EXPECT_GE(agree, 0.99 * problems);
}

}  // namespace
}  // namespace gazed::triangulation::peer_test
