#include "agent/geometry/limits.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>

namespace gazed::geometry::limits_test {
namespace {

// One interpolation between numbers below 3 rounds at about 1e-16.
constexpr double rounding_rad = 1e-14;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Joint ranges of the NAO's URDF, which the limits never exceed.
constexpr double yaw_max_rad = 2.08567;
constexpr AngleRange joint_pitch{-0.671952, 0.514872};

struct Row {
  double yaw_rad, min_rad, max_rad;
};

// The manufacturer's table.
constexpr std::array<Row, 7> table{{{2.086017, -0.449073, 0.330041},
                                    {1.526988, -0.330041, 0.200015},
                                    {1.089958, -0.430049, 0.300022},
                                    {0.903033, -0.479965, 0.330041},
                                    {0.756077, -0.548033, 0.370010},
                                    {0.486074, -0.671951, 0.422021},
                                    {0.0, -0.671951, 0.515047}}};

void expect_range(AngleRange range, double min_rad, double max_rad) {
  EXPECT_NEAR(range.min_rad, min_rad, rounding_rad);
  EXPECT_NEAR(range.max_rad, max_rad, rounding_rad);
}

TEST(HeadLimits, AtTheRowsOfTheTable) {
  const HeadLimits limits;
  for (const Row& row : table) {
    SCOPED_TRACE(row.yaw_rad);
    const double max_rad = std::min(row.max_rad, joint_pitch.max_rad);  // cuts the row at yaw 0
    expect_range(limits.pitch_range(row.yaw_rad), row.min_rad, max_rad);
    expect_range(limits.pitch_range(-row.yaw_rad), row.min_rad, max_rad);
  }
}

TEST(HeadLimits, BetweenTheRowsTheyAreLinear) {
  const HeadLimits limits;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const Row &a = table[i], &b = table[i + 1];
    for (const double part : {0.25, 0.5, 0.75}) {
      const double yaw = a.yaw_rad + part * (b.yaw_rad - a.yaw_rad);
      SCOPED_TRACE(yaw);
      const double min_rad = a.min_rad + part * (b.min_rad - a.min_rad);
      const double max_rad = a.max_rad + part * (b.max_rad - a.max_rad);
      expect_range(limits.pitch_range(yaw), min_rad, max_rad);
      expect_range(limits.pitch_range(-yaw), min_rad, max_rad);
    }
  }
}

TEST(HeadLimits, BeyondTheLastRowTheyAreThatRows) {
  expect_range(HeadLimits().pitch_range(2.5), -0.449073, 0.330041);
  expect_range(HeadLimits().pitch_range(-100.0), -0.449073, 0.330041);
}

TEST(HeadLimits, NeverExceedTheJointRange) {
  const HeadLimits limits;
  EXPECT_EQ(limits.yaw_range().min_rad, -yaw_max_rad);
  EXPECT_EQ(limits.yaw_range().max_rad, yaw_max_rad);
  for (double yaw = -2.1; yaw <= 2.1; yaw += 1e-4) {
    ASSERT_GE(limits.pitch_range(yaw).min_rad, joint_pitch.min_rad);
    ASSERT_LE(limits.pitch_range(yaw).max_rad, joint_pitch.max_rad);
  }
}

TEST(HeadLimits, MarginShrinksEverySide) {
  const HeadLimits limits(0.05);
  EXPECT_EQ(limits.margin_rad(), 0.05);
  EXPECT_NEAR(limits.yaw_range().min_rad, -2.03567, rounding_rad);
  EXPECT_NEAR(limits.yaw_range().max_rad, 2.03567, rounding_rad);
  expect_range(limits.pitch_range(1.526988), -0.280041, 0.150015);
  expect_range(limits.pitch_range(0.0), -0.621951, 0.464872);
}

TEST(HeadLimits, MarginOutsideItsRangeIsRefused) {
  EXPECT_NO_THROW(HeadLimits(0.0));
  EXPECT_NO_THROW(HeadLimits{max_margin_rad});
  EXPECT_THROW(HeadLimits(-1e-9), std::invalid_argument);
  EXPECT_THROW(HeadLimits{max_margin_rad + 1e-9}, std::invalid_argument);
  EXPECT_THROW(HeadLimits{nan}, std::invalid_argument);
}

TEST(HeadLimits, LargestMarginLeavesRoomForAStepEverywhere) {
  // 0.1 rad up or 0.1 rad down from anywhere: a range of 0.2 rad.
  const HeadLimits limits(max_margin_rad);
  for (const double yaw : HeadLimits::break_yaws_rad()) {
    const AngleRange range = limits.pitch_range(yaw);
    EXPECT_GE(range.max_rad - range.min_rad, 0.2) << yaw;
  }
}

TEST(HeadLimits, BreakYawsAreTheRowsOfBothSidesAscending) {
  const auto yaws = HeadLimits::break_yaws_rad();
  ASSERT_EQ(yaws.size(), 2 * table.size() - 1);
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(yaws[i], -table[i].yaw_rad);
    EXPECT_EQ(yaws[yaws.size() - 1 - i], table[i].yaw_rad);
  }
}

TEST(HeadLimits, ContainTheirBordersAndNothingBeyond) {
  const HeadLimits limits;
  EXPECT_TRUE(limits.contains({yaw_max_rad, 0.0}));
  EXPECT_FALSE(limits.contains({yaw_max_rad + 1e-9, 0.0}));
  EXPECT_TRUE(limits.contains({1.526988, 0.200015}));
  EXPECT_FALSE(limits.contains({1.526988, 0.200016}));
  EXPECT_TRUE(limits.contains({-1.526988, -0.330041}));
  EXPECT_FALSE(limits.contains({-1.526988, -0.330042}));
}

TEST(HeadLimits, DoNotContainWhatIsNotANumber) {
  const HeadLimits limits;
  EXPECT_FALSE(limits.contains({nan, 0.0}));
  EXPECT_FALSE(limits.contains({0.0, nan}));
  EXPECT_FALSE(limits.contains_segment({0.0, 0.0}, {nan, 0.0}));
}

TEST(HeadLimits, SegmentIsJudgedAtTheRowsItPasses) {
  const HeadLimits limits;
  // Both ends are inside, the row of 1.526988 between them allows 0.200015.
  EXPECT_TRUE(limits.contains({1.2, 0.22}) && limits.contains({1.9, 0.22}));
  EXPECT_FALSE(limits.contains_segment({1.2, 0.22}, {1.9, 0.22}));
  EXPECT_FALSE(limits.contains_segment({1.9, 0.22}, {1.2, 0.22}));
  EXPECT_FALSE(limits.contains_segment({-1.2, 0.22}, {-1.9, 0.22}));
  EXPECT_TRUE(limits.contains_segment({1.2, 0.2}, {1.9, 0.2}));
  // Likewise below: the row allows -0.330041.
  EXPECT_FALSE(limits.contains_segment({1.2, -0.34}, {1.9, -0.34}));
  EXPECT_TRUE(limits.contains_segment({1.2, -0.33}, {1.9, -0.33}));
}

TEST(HeadLimits, SegmentMayTouchTheRowItPasses) {
  EXPECT_TRUE(HeadLimits().contains_segment({1.426988, 0.2}, {1.626988, 0.20003}));
}

TEST(HeadLimits, SegmentWithAnEndOutsideIsOutside) {
  const HeadLimits limits;
  EXPECT_FALSE(limits.contains_segment({0.0, 0.0}, {0.0, 0.6}));
  EXPECT_FALSE(limits.contains_segment({2.2, 0.0}, {0.0, 0.0}));
}

TEST(HeadLimits, SegmentOfOnePointOrOneYawIsDecidedByItsEnds) {
  const HeadLimits limits;
  EXPECT_TRUE(limits.contains_segment({1.526988, 0.1}, {1.526988, 0.1}));
  EXPECT_TRUE(limits.contains_segment({1.526988, -0.33}, {1.526988, 0.2}));
}

TEST(HeadLimits, SegmentAlongTheBorderOfTwoRowsIsInside) {
  for (const double margin : {0.0, 0.05, max_margin_rad}) {
    const HeadLimits limits(margin);
    const double from = 0.800000, to = 0.850000;  // between the rows of 0.756077 and 0.903033
    EXPECT_TRUE(limits.contains_segment({from, limits.pitch_range(from).max_rad},
                                        {to, limits.pitch_range(to).max_rad}));
  }
}

TEST(HeadLimits, SegmentAnswersAsAThousandPointsOfIt) {
  const HeadLimits limits(0.02);
  std::mt19937_64 bits(3);
  const auto uniform = [&](double min, double max) {
    return min + (max - min) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  };
  // The points may miss a row by 1/1000 of the way, where the limits turn by less than 0.8 rad/rad.
  constexpr double missed_rad = 4.2e-3 * 0.8;
  for (int i = 0; i < 5000; ++i) {
    const HeadAngles from{uniform(-2.1, 2.1), uniform(-0.68, 0.52)};
    const HeadAngles to{uniform(-2.1, 2.1), uniform(-0.68, 0.52)};
    double least_slack = 1.0;
    for (int k = 0; k <= 1000; ++k) {
      const HeadAngles at{from.yaw_rad + k / 1000.0 * (to.yaw_rad - from.yaw_rad),
                          from.pitch_rad + k / 1000.0 * (to.pitch_rad - from.pitch_rad)};
      const AngleRange yaws = limits.yaw_range(), pitches = limits.pitch_range(at.yaw_rad);
      least_slack = std::min({least_slack, yaws.max_rad - at.yaw_rad, at.yaw_rad - yaws.min_rad,
                              pitches.max_rad - at.pitch_rad, at.pitch_rad - pitches.min_rad});
    }
    if (limits.contains_segment(from, to)) {
      ASSERT_GE(least_slack, -1e-12);
    } else {
      ASSERT_LT(least_slack, missed_rad);
    }
  }
}

TEST(HeadLimits, ClampKeepsWhatIsInside) {
  const HeadAngles inside{1.0, -0.2};
  EXPECT_EQ(HeadLimits(0.05).clamp(inside), inside);
}

TEST(HeadLimits, ClampTakesYawFirstThenPitchAtThatYaw) {
  const HeadLimits limits(0.05);
  const HeadAngles clamped = limits.clamp({3.0, -1.0});
  EXPECT_EQ(clamped.yaw_rad, limits.yaw_range().max_rad);
  EXPECT_EQ(clamped.pitch_rad, limits.pitch_range(clamped.yaw_rad).min_rad);
  EXPECT_TRUE(limits.contains(clamped));
  const HeadAngles high = limits.clamp({0.0, 1.0});
  EXPECT_EQ(high.yaw_rad, 0.0);
  EXPECT_EQ(high.pitch_rad, limits.pitch_range(0.0).max_rad);
}

}  // namespace
}  // namespace gazed::geometry::limits_test
