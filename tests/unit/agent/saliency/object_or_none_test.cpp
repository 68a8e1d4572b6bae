#include "agent/saliency/object_or_none.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

#include "agent/saliency/fixed.hpp"

#include "tests/unit/agent/saliency/grid.hpp"

namespace gazed::saliency::object_or_none_test {
namespace {

TEST(CoarseLog, IsExactAtPowersOfTwoAndLinearBetweenThem) {
  EXPECT_EQ(coarse_log2(1.0), 0.0);
  EXPECT_EQ(coarse_log2(8.0), 3.0);
  EXPECT_EQ(coarse_log2(0x1p-13), -13.0);
  EXPECT_EQ(coarse_log2(1.5), 0.5);
  EXPECT_EQ(coarse_log2(0.375), -1.5);
}

TEST(CoarseLog, IsNearTheLogarithm) {
  constexpr double most = 0.0861;  // of log2(x) - (x - 1), at x = 1 / ln 2
  for (double x = 0.01; x < 1e4; x *= 1.03) {
    EXPECT_LE(coarse_log2(x), std::log2(x) + 1e-12);
    EXPECT_GE(coarse_log2(x), std::log2(x) - most);
  }
}

TEST(CoarseLog, TheExponentialIsItsInverse) {
  constexpr double rounding = 1e-14;  // relative: a few units in the last place
  for (double x = 0.01; x < 1e4; x *= 1.03)
    EXPECT_NEAR(coarse_exp2(coarse_log2(x)), x, rounding * x);
  EXPECT_EQ(coarse_exp2(-60.0), 0x1p-60);
}

/// A map and planes of 40x30; the object is 4x4 samples in the middle.
struct Frame {
  Frame() {
    each_of_object([&](int x, int y) { map.at(x, y) = 255 << conspicuity_fraction_bits; });
  }

  template <typename Visit>
  void each_of_object(Visit&& visit) {
    for (int y = 13; y < 17; ++y)
      for (int x = 18; x < 22; ++x) visit(x, y);
  }
  FrameStatistics statistics() {
    return ObjectOrNone().statistics(map.plane(), {.peak = 1.0, .mean = 0.125},
                                     {planes[0].plane(), planes[1].plane(), planes[2].plane()});
  }

  Grid<std::int32_t> map{40, 30};
  std::array<Grid<std::int16_t>, 3> planes{Grid<std::int16_t>{40, 30, 100 * 48},
                                           Grid<std::int16_t>{40, 30}, Grid<std::int16_t>{40, 30}};
};

// Rounding of the logarithms' fractions.
constexpr double rounding = 1e-9;

TEST(ObjectOrNone, AFrameOfOneColour) {
  const FrameStatistics s = Frame().statistics();
  EXPECT_NEAR(s.attention, -3.0, 0.01);  // of 1/8, and a little
  EXPECT_EQ(s.apart, 0.0);
  EXPECT_EQ(s.colours, 0.0);
  EXPECT_EQ(s.contrast, 0.0);
  EXPECT_EQ(s.at_border, 0.0);
  EXPECT_EQ(s.border_mix, 0.0);
}

// 45 levels of red-green are 15 of the 3 that a border of one colour is said to spread by.
TEST(ObjectOrNone, AnObjectIsApartFromTheBordersColour) {
  Frame frame;
  frame.each_of_object([&](int x, int y) { frame.planes[1].at(x, y) = 45 * 64; });
  const FrameStatistics s = frame.statistics();
  EXPECT_NEAR(s.apart, 0.5 * coarse_log2(1.0 + 15.0 * 15.0), rounding);
  EXPECT_EQ(s.colours, 1.0);
  EXPECT_EQ(s.contrast, 0.0);
  EXPECT_EQ(s.border_mix, 0.0);
}

// Columns of 80 and 120 in turn: as many of each along the border.
TEST(ObjectOrNone, ABorderOfTwoLevels) {
  Frame frame;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      frame.planes[0].at(x, y) = static_cast<std::int16_t>((x % 2 == 0 ? 80 : 120) * 48);
  const FrameStatistics s = frame.statistics();
  EXPECT_NEAR(s.border_mix, 0.5 * coarse_log2(1.0 + 20.0 * 20.0), rounding);
  EXPECT_NEAR(s.contrast, 0.5 * coarse_log2(1.0 + 20.0 * 20.0), rounding);
  EXPECT_EQ(s.colours, 1.0);
}

TEST(ObjectOrNone, WhatStandsOutAtTheBorder) {
  Frame frame;
  for (int x = 0; x < 40; ++x) frame.map.at(x, 0) = (255 << conspicuity_fraction_bits) / 2;
  constexpr double border_samples = 2 * 40 + 2 * 28;
  EXPECT_NEAR(frame.statistics().at_border, 0.5 * 40 / border_samples, 1e-6);
}

TEST(ObjectOrNone, ColoursOfAFrameOfTwiceTheSizeAreCountedAtEverySecondSample) {
  Grid<std::int32_t> map(80, 60);
  map.at(40, 30) = 255 << conspicuity_fraction_bits;
  Grid<std::int16_t> intensity(80, 60, 100 * 48), colourless(80, 60);
  intensity.at(41, 30) = 200 * 48;
  const auto colours = [&] {
    return ObjectOrNone()
        .statistics(map.plane(), {.peak = 1.0, .mean = 0.1},
                    {intensity.plane(), colourless.plane(), colourless.plane()})
        .colours;
  };
  EXPECT_EQ(colours(), 0.0);
  intensity.at(42, 30) = 200 * 48;
  EXPECT_EQ(colours(), 1.0);
}

TEST(ObjectOrNone, TheExtremesOfThePlanesHaveAPlaceAmongTheColours) {
  Frame frame;
  for (const std::int32_t value : {-largest_sample, largest_sample}) {
    for (auto& plane : frame.planes) plane.at(0, 0) = static_cast<std::int16_t>(value);
    EXPECT_EQ(frame.statistics().colours, 1.0);
  }
}

// A middling object of ECSSD, then what makes a frame bland and what makes it busy.
TEST(ObjectShare, BlandFramesAndBusyOnesHaveLess) {
  const FrameStatistics object{.attention = -3.0,
                               .apart = 2.0,
                               .colours = 6.0,
                               .contrast = 5.5,
                               .at_border = 0.05,
                               .border_mix = 5.0};
  const double share = object_share(object);
  EXPECT_GT(share, 0.5);
  FrameStatistics bland = object;
  bland.colours = 2.0;
  bland.apart = 0.5;
  EXPECT_LT(object_share(bland), share / 2.0);
  FrameStatistics at_border = object;
  at_border.at_border = 0.5;
  EXPECT_LT(object_share(at_border), share / 2.0);
  FrameStatistics busy = object;
  busy.attention = -5.0;
  busy.contrast = 6.5;
  EXPECT_LT(object_share(busy), share / 2.0);
}

TEST(ObjectShare, WhateverTheStatisticsItIsAShare) {
  for (const double far : {-60.0, 0.0, 60.0}) {
    const double share = object_share({far, far, far, far, far, far});
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
  }
}

}  // namespace
}  // namespace gazed::saliency::object_or_none_test
