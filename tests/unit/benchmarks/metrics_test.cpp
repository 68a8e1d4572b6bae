#include "tests/benchmarks/metrics.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <vector>

namespace gazed::benchmarks::metrics_test {
namespace {

using Cells = std::vector<cv::Point>;

constexpr double rounding = 1e-12;

/// 1 2 3
/// 4 5 6
cv::Mat one_to_six() {
  return (cv::Mat_<double>(2, 3) << 1, 2, 3, 4, 5, 6);
}

TEST(AreaUnderCurve, IsTheShareOfPairsWon) {
  EXPECT_EQ(area_under_curve({3, 4}, {1, 2}), 1.0);
  EXPECT_EQ(area_under_curve({1, 2}, {3, 4}), 0.0);
  EXPECT_EQ(area_under_curve({1, 4}, {2, 3}), 0.5);
  EXPECT_EQ(area_under_curve({2, 4, 5}, {3}), 2.0 / 3.0);
}

TEST(AreaUnderCurve, TiesCountHalf) {
  EXPECT_EQ(area_under_curve({7, 7}, {7, 7, 7}), 0.5);
  EXPECT_EQ(area_under_curve({1, 2}, {1}), 0.75);
}

TEST(AreaUnderCurve, NothingToCompareIsNoNumber) {
  EXPECT_TRUE(std::isnan(area_under_curve({}, {1})));
  EXPECT_TRUE(std::isnan(area_under_curve({1}, {})));
}

TEST(Nss, IsTheMeanInStandardDeviations) {
  // Mean 3.5, variance (2.5^2 + 1.5^2 + 0.5^2) / 3 = 35/12.
  EXPECT_NEAR(nss(one_to_six(), Cells{{2, 1}}), 2.5 / std::sqrt(35.0 / 12.0), rounding);
  EXPECT_NEAR(nss(one_to_six(), Cells{{2, 1}, {0, 0}}), 0.0, rounding);
}

TEST(Nss, EveryFixationOfACellCounts) {
  EXPECT_NEAR(nss(one_to_six(), Cells{{2, 1}, {2, 1}, {0, 0}}), 2.5 / 3 / std::sqrt(35.0 / 12.0),
              rounding);
}

TEST(Nss, DoesNotDependOnScaleAndOffset) {
  const Cells cells{{1, 0}, {2, 1}};
  EXPECT_NEAR(nss(3.0 * one_to_six() + 8.0, cells), nss(one_to_six(), cells), rounding);
}

TEST(Nss, FlatMapIsZeroAndNoFixationNoNumber) {
  EXPECT_EQ(nss(cv::Mat(2, 3, CV_64F, cv::Scalar(4)), Cells{{0, 0}}), 0.0);
  EXPECT_TRUE(std::isnan(nss(one_to_six(), {})));
}

TEST(AucJudd, FixatedCellsAgainstAllOthers) {
  EXPECT_EQ(auc_judd(one_to_six(), Cells{{2, 1}}), 1.0);
  EXPECT_EQ(auc_judd(one_to_six(), Cells{{0, 0}}), 0.0);
  EXPECT_EQ(auc_judd(one_to_six(), Cells{{2, 0}}), 2.0 / 5.0);  // 3 is above 1 and 2 of five
  EXPECT_EQ(auc_judd(cv::Mat(2, 3, CV_64F, cv::Scalar(4)), Cells{{0, 0}}), 0.5);
}

TEST(AucJudd, ACellCountsOnce) {
  EXPECT_EQ(auc_judd(one_to_six(), Cells{{2, 0}, {2, 0}}), auc_judd(one_to_six(), Cells{{2, 0}}));
}

TEST(ShuffledAuc, FixationsAgainstThoseElsewhere) {
  const Cells here{{2, 1}, {1, 1}};       // 6, 5
  const Cells elsewhere{{2, 1}, {0, 0}};  // 6, 1
  EXPECT_EQ(shuffled_auc(one_to_six(), here, elsewhere), (0.5 + 1.0 + 0.0 + 1.0) / 4.0);
}

TEST(ShuffledAuc, ACentreBiasAloneIsWorthNothing) {
  const Cells centre{{1, 0}, {1, 1}, {1, 0}};
  EXPECT_EQ(shuffled_auc(one_to_six(), centre, centre), 0.5);
}

TEST(ScoredSize, ARampKeepsItsValueAtEveryPixel) {
  cv::Mat map(30, 40, CV_64F);
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x) map.at<double>(y, x) = 16 * x + 1000 * 16 * y;
  const cv::Mat scored = at_scored_size(map);
  ASSERT_EQ(scored.size(), cv::Size(80, 60));
  // Cell k is centred on pixel 8 k + 3.5; behind sample 39 (29), pixel 624 (464), it goes on flat.
  EXPECT_NEAR(scored.at<double>(0, 0), 3.5 + 1000 * 3.5, 1e-9);
  EXPECT_NEAR(scored.at<double>(31, 10), 83.5 + 1000 * 251.5, 1e-9);
  EXPECT_NEAR(scored.at<double>(59, 79), 624.0 + 1000 * 464.0, 1e-9);
}

}  // namespace
}  // namespace gazed::benchmarks::metrics_test
