#include "agent/lab/explain/charts.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace gazed::lab::explain::charts_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double rounding = 1e-12;

/// Half a metre away, 10 % of it uncertain: three quarters of the variance by the encoders, the
/// rest by the target's pixels.
cycle::Fixation half_a_metre_away() {
  cycle::Fixation fixation;
  fixation.estimate.inverse_range_per_m = 2.0;
  fixation.estimate.inverse_range_sigma_per_m = 0.2;
  fixation.budget.variance_per_m2.fill(0.0);
  fixation.budget.variance_per_m2[0] = 0.03;
  fixation.budget.variance_per_m2[9] = 0.01;
  fixation.look_count = 2;
  fixation.looks[1].pair_inverse_range_per_m = 2.1;
  fixation.looks[1].pair_inverse_range_sigma_per_m = 3.0;
  fixation.looks[1].used = true;
  fixation.report_range_m = -0.23;
  return fixation;
}

TEST(RangeInterval, IsOneOfInverseRange) {
  const auto interval = interval_of(2.0, 0.5, 2.0);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->near_m, 1.0 / 3.0, rounding);
  EXPECT_NEAR(interval->far_m, 1.0, rounding);
}

TEST(RangeInterval, ReachesInfinityAndBeyondItIsNone) {
  EXPECT_EQ(interval_of(2.0, 1.0, 2.0)->far_m, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(interval_of(-2.0, 0.5, 2.0));
  EXPECT_FALSE(interval_of(triangulation::not_a_number, 0.5, 2.0));
}

TEST(Costs, AreSharesOfTheVarianceTheDearestFirst) {
  const std::vector<Cost> costs = costs_of(half_a_metre_away());
  ASSERT_EQ(costs.size(), triangulation::all_looks::cause_count);
  EXPECT_EQ(costs[0].cause, "encoders");
  EXPECT_NEAR(costs[0].share, 0.75, rounding);
  EXPECT_NEAR(costs[0].alone, std::sqrt(0.03) / 2.0, rounding);
  EXPECT_NEAR(costs[0].without, 0.05, rounding);
  EXPECT_EQ(costs[1].cause, "target pixels");
  const double sum =
      std::accumulate(costs.begin(), costs.end(), 0.0,
                      [](double so_far, const Cost& cost) { return so_far + cost.share; });
  EXPECT_NEAR(sum, 1.0, rounding);
}

TEST(Costs, OfNoAnswerThereAreNone) {
  EXPECT_TRUE(costs_of({}).empty());
  cycle::Fixation at_infinity = half_a_metre_away();
  at_infinity.estimate.inverse_range_per_m = 0.0;
  EXPECT_TRUE(costs_of(at_infinity).empty());
}

TEST(Charts, HaveARowForEachPairAndForTheWhole) {
  const std::string script = interval_script(half_a_metre_away(), "name");
  EXPECT_THAT(script, HasSubstr("\"all looks together\" 0, \"looks 1 and 2 alone\" -1"));
  EXPECT_THAT(script, HasSubstr("set output \"name.svg\""));
  EXPECT_THAT(script, HasSubstr("set output \"name.png\""));
}

// A logarithmic axis has no place for what is behind the camera; the page says it in words.
TEST(Charts, LeaveOutAReportsAnswerBehindTheCamera) {
  EXPECT_THAT(interval_script(half_a_metre_away(), "name"), Not(HasSubstr("the report's steps")));
  cycle::Fixation in_front = half_a_metre_away();
  in_front.report_range_m = 1.27;
  EXPECT_THAT(interval_script(in_front, "name"), HasSubstr("the report's steps"));
}

TEST(Charts, AreNotDrawnOfNothing) {
  EXPECT_EQ(interval_script({}, "name"), "");
  EXPECT_EQ(costs_script({}, "name"), "");
}

}  // namespace
}  // namespace gazed::lab::explain::charts_test
