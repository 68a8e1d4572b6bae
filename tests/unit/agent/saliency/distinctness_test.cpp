#include "agent/saliency/distinctness.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/comparison.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/grid.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::saliency::distinctness_test {
namespace {

using frames::Canvas;

struct Map : Grid<std::int16_t> {
  using Grid::Grid;
  std::int32_t height_at(int x, int y, std::int32_t least = 0) {
    return enclosure.height_at(plane(), x, y, least);
  }

  Enclosure enclosure{plane().width, plane().height};
};

TEST(Enclosure, ABrightSummitIsAsHighAsItsHighestWayOut) {
  Map p(20, 15, 100);
  for (int y = 4; y <= 8; ++y)
    for (int x = 6; x <= 10; ++x) p.at(x, y) = 900;
  EXPECT_EQ(p.height_at(8, 6), 800);
  for (int x = 0; x <= 6; ++x) p.at(x, 6) = 700;  // a ridge to the border
  EXPECT_EQ(p.height_at(8, 6), 200);
}

TEST(Enclosure, ADarkPlaceCountsAsABrightOne) {
  Map p(20, 15, 100);
  p.at(12, 7) = -300;
  EXPECT_EQ(p.height_at(12, 7), 400);
}

TEST(Enclosure, TheSummitMayBeANeighbour) {
  Map p(20, 15, 100);
  p.at(12, 7) = 500;
  EXPECT_EQ(p.height_at(11, 6), 400);
  EXPECT_EQ(p.height_at(10, 6), 0);
}

TEST(Enclosure, WhatTheBorderCutsAndASlopeAreNotEnclosed) {
  Map cut(20, 15, 100), slope(20, 15, 0);
  for (int y = 0; y < 5; ++y) cut.at(9, y) = 900;
  EXPECT_EQ(cut.height_at(9, 3), 0);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) slope.at(x, y) = static_cast<std::int16_t>(30 * x + 10 * y);
  EXPECT_EQ(slope.height_at(10, 7), 0);
}

TEST(Enclosure, KeepsNothingFromThePlaneBefore) {
  Map p(20, 15, 100);
  EXPECT_EQ(p.height_at(10, 7), 0);
  p.at(10, 7) = 500;
  EXPECT_EQ(p.height_at(10, 7), 400);
  EXPECT_EQ(p.height_at(10, 7), 400);
}

TEST(Enclosure, LessThanWhatIsKnownAlreadyChangesNothing) {
  Map p(20, 15, 100);
  p.at(10, 7) = 500;
  EXPECT_EQ(p.height_at(10, 7, 399), 400);
  EXPECT_EQ(p.height_at(10, 7, 401), 401);
}

// A wall with a winding way out: no straight way is as good.
TEST(Enclosure, TheBestWayNeedNotBeStraight) {
  Map p(20, 15, 100);
  for (int x = 6; x <= 10; ++x) p.at(x, 7) = 900;
  for (int y = 3; y <= 7; ++y) p.at(6, y) = 800;
  for (int x = 0; x <= 6; ++x) p.at(x, 3) = 700;
  EXPECT_EQ(p.height_at(10, 7), 200);
}

class DistinctnessOf : public testing::TestWithParam<SaliencyProfile> {
 protected:
  double of(const Canvas& canvas) {
    SaliencySettings settings;
    settings.profile = GetParam();
    const base::ImageView view = canvas.view();
    const double value =
        Saliency(settings, view.width_px, view.height_px).examine(view).distinctness;
    EXPECT_GE(value, 0.0);
    EXPECT_LE(value, 1.0);
    return value;
  }
  [[nodiscard]] const char* name() const {
    return profile_names[static_cast<std::size_t>(GetParam())].data();
  }
  double threshold = SaliencySettings{}.distinctness_min;
};

INSTANTIATE_TEST_SUITE_P(Profiles, DistinctnessOf,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust,
                                         SaliencyProfile::surround),
                         profile_name);

TEST_P(DistinctnessOf, AFrameWithoutAnyContrastIsZero) {
  for (const frames::Colour& colour :
       {frames::black, frames::white, frames::grey, frames::red, frames::blue})
    EXPECT_EQ(of(Canvas(640, 480, colour)), 0.0);
}

// Amplitude 2: a standard deviation of 2.8 grey levels.
TEST_P(DistinctnessOf, GreyWithNoiseHasNoSalientObject) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= test::trials(5, 1); ++seed)
    for (std::uint8_t level : {40, 80, 128, 220})
      for (int amplitude : {1, 2})
        worst = std::max(worst, of(Canvas(640, 480, {level, level, level}).noise(amplitude, seed)));
  std::printf("%s: grey with noise, at most %.3f\n", name(), worst);
  EXPECT_LT(worst, 0.01);
}

TEST_P(DistinctnessOf, AnEmptyShadedWallHasNoSalientObject) {
  double worst = 0.0;
  for (int percent : {15, 40, 70}) {
    for (const frames::Colour& colour :
         {frames::Colour{220, 220, 220}, {220, 210, 190}, {200, 215, 220}}) {
      for (int amplitude : {0, 1, 2}) {
        if (test::few_trials && amplitude != 1) continue;
        const Canvas wall(640, 480, colour);
        worst = std::max({worst, of(Canvas(wall).vignette(percent).noise(amplitude, 1)),
                          of(Canvas(wall).shade_to_the_right(percent).noise(amplitude, 1))});
      }
    }
  }
  std::printf("%s: empty walls, at most %.3f\n", name(), worst);
  EXPECT_LT(worst, threshold);
}

// Discs of 16 to 120 px, of which two are cut off by the border.
TEST_P(DistinctnessOf, AnObjectOnAWallIsDistinct) {
  int count = 0, distinct = 0;
  for (const frames::Colour& colour :
       {frames::Colour{200, 30, 30}, {120, 20, 25}, {30, 60, 170}, {40, 140, 60}, {230, 130, 30}}) {
    for (int radius : {8, 15, 30, 60}) {
      if (test::few_trials && radius != 15) continue;
      for (const auto& [x, y] :
           {std::pair{320, 240}, {100, 90}, {560, 400}, {320, 420}, {48, 240}}) {
        const Canvas canvas =
            Canvas(640, 480, {220, 220, 215}).disc(x, y, radius, colour).vignette(30).noise(1, 1);
        distinct += of(canvas) >= threshold ? 1 : 0;
        ++count;
      }
    }
  }
  std::printf("%s: %d of %d discs are distinct\n", name(), distinct, count);
  EXPECT_GE(distinct, count * 95 / 100);
}

TEST_P(DistinctnessOf, ARedObjectOnAWhiteWallIsVeryDistinct) {
  for (int radius : {12, 20, 30})
    for (const auto& [x, y] : {std::pair{320, 240}, {90, 80}, {560, 390}})
      EXPECT_GT(of(Canvas(640, 480, {225, 225, 220})
                       .disc(x, y, radius, {200, 30, 30})
                       .vignette(20)
                       .noise(1, 1)),
                0.5);
}

}  // namespace
}  // namespace gazed::saliency::distinctness_test
