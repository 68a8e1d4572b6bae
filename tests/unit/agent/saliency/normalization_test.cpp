// N's definition, case by case.
#include "agent/saliency/normalization.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <random>

#include "tests/unit/agent/saliency/grid.hpp"
#include "tests/unit/agent/saliency/reference.hpp"

namespace gazed::saliency::normalization_test {
namespace {

using Map = Grid<std::int16_t>;

double weight_of(Map map, int floor = 0) {
  return static_cast<double>(promotion_weight(find_peaks(map.plane()), floor)) /
         (1 << weight_fraction_bits);
}

// One unit of the weight's last place, and of 1 - m/M squared in Q30.
constexpr double weight_tolerance = 1e-6;

TEST(Normalization, ASinglePeakIsPromotedNotZeroed) {
  Map map(9, 7, 0);
  map.at(4, 3) = 1000;
  EXPECT_EQ(find_peaks(map.plane()).others, 0);
  EXPECT_NEAR(weight_of(map), 255.0 / 1000.0, weight_tolerance);
}

TEST(Normalization, TheMeanIsOverTheOtherMaxima) {
  Map map(9, 7, 0);
  map.at(2, 3) = 1000;
  map.at(6, 2) = 400;
  map.at(6, 5) = 200;
  EXPECT_NEAR(weight_of(map), 255.0 / 1000.0 * 0.7 * 0.7, weight_tolerance);
}

TEST(Normalization, AFlatMapHasNoMaxima) {
  Map map(9, 7, 500);
  const MapPeaks peaks = find_peaks(map.plane());
  EXPECT_EQ(peaks.maximum, 500);
  EXPECT_EQ(peaks.others, 0);
  EXPECT_NEAR(weight_of(map), 255.0 / 500.0, weight_tolerance);
}

TEST(Normalization, AnEmptyMapHasNoWeight) {
  EXPECT_EQ(weight_of(Map(9, 7, 0)), 0.0);
}

TEST(Normalization, OfTwoEqualMaximaOneIsLeftOutAndTheOtherCounts) {
  Map map(9, 7, 0);
  map.at(2, 2) = map.at(6, 4) = 800;
  const MapPeaks peaks = find_peaks(map.plane());
  EXPECT_EQ(peaks.maximum_x, 2);
  EXPECT_EQ(peaks.maximum_y, 2);
  EXPECT_EQ(peaks.others, 1);
  EXPECT_EQ(peaks.sum_of_others, 800);
  EXPECT_EQ(weight_of(map), 0.0);  // (M - m)^2 = 0: neither stands out
}

// Both samples are not below any neighbour and above at least one: two maxima.
TEST(Normalization, APlateauOfTwoSamplesIsTwoMaxima) {
  Map map(9, 7, 100);
  map.at(3, 3) = map.at(4, 3) = 600;
  EXPECT_EQ(find_peaks(map.plane()).others, 1);
}

// Inside a wide plateau no sample is above a neighbour; its rim counts.
TEST(Normalization, TheInsideOfAPlateauIsNoMaximum) {
  Map map(9, 9, 0);
  for (int y = 3; y <= 5; ++y)
    for (int x = 3; x <= 5; ++x) map.at(x, y) = 600;
  EXPECT_EQ(find_peaks(map.plane()).others, 8 - 1);
}

// The global maximum on the border is not in the list, so nothing is left out of it.
TEST(Normalization, AMaximumOnTheBorderIsNotInTheList) {
  Map map(9, 7, 0);
  map.at(0, 3) = 1000;
  map.at(5, 3) = 500;
  const MapPeaks peaks = find_peaks(map.plane());
  EXPECT_EQ(peaks.maximum, 1000);
  EXPECT_EQ(peaks.others, 1);
  EXPECT_NEAR(weight_of(map), 255.0 / 1000.0 * 0.25, weight_tolerance);
}

TEST(Normalization, WithTheFirstOfEqualMaximaOnTheBorderTheOneInsideCounts) {
  Map map(9, 7, 0);
  map.at(4, 0) = map.at(4, 4) = 1000;
  EXPECT_EQ(find_peaks(map.plane()).others, 1);
}

TEST(Normalization, ATenthOfTheMaximumIsTooLittle) {
  Map map(9, 7, 0);
  map.at(2, 3) = 1000;
  map.at(6, 3) = 100;
  EXPECT_EQ(find_peaks(map.plane()).others, 0);
  map.at(6, 3) = 101;
  EXPECT_EQ(find_peaks(map.plane()).others, 1);
}

TEST(Normalization, OnlyTheFourNeighboursCount) {
  Map map(9, 7, 0);
  map.at(2, 2) = 1000;
  map.at(5, 4) = 300;
  map.at(6, 5) = 400;  // diagonal
  EXPECT_EQ(find_peaks(map.plane()).others, 2);
}

TEST(Normalization, BelowTheNoiseFloorAMapHasNoSay) {
  Map map(9, 7, 0);
  map.at(4, 3) = 47;
  EXPECT_EQ(weight_of(map, 48), 0.0);
  EXPECT_GT(weight_of(map, 47), 0.0);
}

TEST(Normalization, AMapOfOneSampleOrOneRowHasNoMaxima) {
  EXPECT_EQ(find_peaks(Map(1, 1, 7).plane()).others, 0);
  EXPECT_EQ(find_peaks(Map(20, 1, 7).plane()).maximum, 7);
}

TEST(Normalization, AgreesWithTheReferenceOnRandomMaps) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Map map(static_cast<int>(3 + random() % 60), static_cast<int>(3 + random() % 40), 0);
    const std::uint64_t range = std::uint64_t{1} << (1 + random() % 15);  // few values: many ties
    cv::Mat wide(map.plane().height, map.plane().width, CV_64F);
    for (int y = 0; y < map.plane().height; ++y)
      for (int x = 0; x < map.plane().width; ++x)
        wide.at<double>(y, x) = map.at(x, y) = static_cast<std::int16_t>(random() % range);
    EXPECT_NEAR(weight_of(map), reference::promotion(wide, 0.0), weight_tolerance);
  }
}

// 15 significant bits of the weight, and a sample cut off.
TEST(Normalization, WeightedMapsAreAddedInQ16) {
  for (const double weight : {1e-6, 0.0073, 0.9, 3.14159, 255.0}) {
    OwnedPlane<std::int16_t> map(13, 3);
    OwnedPlane<std::int32_t> sum(13, 3);
    fill(sum.view(), 5);
    const auto largest =
        static_cast<std::int16_t>(std::min(32767.0, std::ldexp(1.0, 15) / weight / 2));
    for (int x = 0; x < 13; ++x) map.view().row(1)[x] = static_cast<std::int16_t>(largest * x / 12);
    const auto fixed = static_cast<std::uint64_t>(std::ldexp(weight, weight_fraction_bits));
    add_weighted(map.view(), fixed, weight_fraction_bits, sum.view());
    for (int x = 0; x < 13; ++x) {
      const double expected = 5 + std::ldexp(static_cast<double>(fixed) * map.view().row(1)[x],
                                             16 - weight_fraction_bits);
      EXPECT_NEAR(sum.view().row(1)[x], expected, 1.0 + expected * 1e-4) << weight;
      EXPECT_EQ(sum.view().row(0)[x], 5);
    }
  }
}

}  // namespace
}  // namespace gazed::saliency::normalization_test
