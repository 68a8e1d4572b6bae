// The winner keeps its place against noise, not against a rival that is clearly higher; and it is
// followed when it moves.
#include "agent/saliency/hysteresis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/grid.hpp"

namespace gazed::saliency::hysteresis_test {
namespace {

using frames::Canvas;

constexpr std::int32_t tenth = (1 << margin_fraction_bits) / 10;

struct Map : Grid<std::int32_t> {
  using Grid::Grid;

  /// A pyramid with a square base, over what is there.
  Map& peak(int x, int y, std::int32_t value, int half_width) {
    for (int v = 0; v < plane().height; ++v) {
      for (int u = 0; u < plane().width; ++u) {
        const int distance = std::max(std::abs(u - x), std::abs(v - y));
        at(u, v) = std::max(at(u, v), value - value * distance / half_width);
      }
    }
    return *this;
  }
  [[nodiscard]] Winner winner(const geometry::Pixel& previous_px, std::int32_t margin = tenth) {
    return find_winner(plane(), previous_px, margin);
  }
};

void expect_sample(const Winner& winner, int x, int y) {
  EXPECT_EQ(winner.x, x);
  EXPECT_EQ(winner.y, y);
}

TEST(Hysteresis, ThePreviousWinnerKeepsItsPlaceUpToTheMargin) {
  const auto with_rival = [](std::int32_t rival) {
    return Map(40, 30).peak(10, 10, 10000, 4).peak(30, 20, rival, 4).winner({160, 160});
  };
  expect_sample(with_rival(9000), 10, 10);
  expect_sample(with_rival(10900), 10, 10);
  expect_sample(with_rival(11100), 30, 20);
}

TEST(Hysteresis, ItIsRefinedLikeAnyWinner) {
  Map map = Map(40, 30).peak(10, 10, 10000, 4).peak(30, 20, 10500, 4);
  map.at(11, 10) = 9999;
  const Winner winner = map.winner({160, 160});
  expect_sample(winner, 10, 10);
  EXPECT_GT(winner.pixel.x(), 160.0);
  EXPECT_LT(winner.pixel.x(), 168.0);
}

TEST(Hysteresis, WithoutAMarginTheHigherPeakWins) {
  Map map = Map(40, 30).peak(10, 10, 10000, 4).peak(30, 20, 10001, 4);
  expect_sample(map.winner({160, 160}, 0), 30, 20);
}

TEST(Hysteresis, OfEqualPeaksThePreviousOneWins) {
  Map map = Map(40, 30).peak(10, 10, 10000, 4).peak(30, 20, 10000, 4);
  expect_sample(map.winner({480, 320}, 0), 30, 20);
}

TEST(Hysteresis, APeakThatMovedByLessThanItsWidthIsFollowed) {
  Map map = Map(40, 30).peak(13, 10, 10000, 4).peak(30, 20, 10500, 4);
  expect_sample(map.winner({160, 160}), 13, 10);
}

TEST(Hysteresis, APreviousWinnerOutsideTheMapCountsForNothing) {
  Map map = Map(40, 30).peak(10, 10, 10000, 4).peak(30, 20, 10001, 4);
  for (const geometry::Pixel& pixel :
       {geometry::Pixel(-9, 100), geometry::Pixel(640, 100), geometry::Pixel(100, 480),
        geometry::Pixel(std::nan(""), 100), geometry::Pixel(1e300, -INFINITY)})
    expect_sample(map.winner(pixel), 30, 20);
}

TEST(Hysteresis, APlaceThatFellToNothingLoses) {
  Map map = Map(40, 30).peak(30, 20, 1, 1);
  expect_sample(map.winner({160, 160}), 30, 20);
}

TEST(Hysteresis, AFlatMapKeepsTheSample) {
  expect_sample(Map(40, 30).winner({160, 176}), 10, 11);
  expect_sample(Map(1, 1).winner({0, 0}), 0, 0);
}

TEST(Hysteresis, CornersAreLikeOtherPlaces) {
  Map map = Map(40, 30).peak(39, 29, 10000, 4).peak(5, 5, 10500, 4);
  expect_sample(map.winner({639, 471}), 39, 29);
}

// Whatever the map and the place: the winner is a local maximum, and nothing exceeds it by more
// than the margin.
TEST(Hysteresis, TheWinnerIsAPeakWithinTheMargin) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 500; ++round) {
    const int width = 1 + static_cast<int>(random() % 12);
    const int height = 1 + static_cast<int>(random() % 12);
    Map map(width, height);
    const std::uint64_t range = round % 3 == 0 ? 4 : 255 << 16;
    std::int32_t largest = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        map.at(x, y) = static_cast<std::int32_t>(random() % range);
        largest = std::max(largest, map.at(x, y));
      }
    }
    const geometry::Pixel previous(static_cast<double>(random() % 200),
                                   static_cast<double>(random() % 200));
    const Winner winner = map.winner(previous);
    const std::int32_t value = map.at(winner.x, winner.y);
    for (int y = std::max(winner.y - 1, 0); y <= std::min(winner.y + 1, height - 1); ++y)
      for (int x = std::max(winner.x - 1, 0); x <= std::min(winner.x + 1, width - 1); ++x)
        ASSERT_LE(map.at(x, y), value);
    ASSERT_LE(std::int64_t{largest} << margin_fraction_bits,
              std::int64_t{value} * ((1 << margin_fraction_bits) + tenth));
  }
}

// Frames.

SaliencySettings with_hysteresis(SaliencyProfile profile, double share) {
  SaliencySettings settings;
  settings.profile = profile;
  settings.hysteresis = share;
  return settings;
}

// How often the winner is at another disc than in the frame before, as a camera would see a wall
// with two discs alike.
int flips_among_twins(const SaliencySettings& settings) {
  Saliency saliency(settings, 640, 480);
  FrameContext context;
  int flips = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Canvas canvas = Canvas(640, 480, {205, 205, 195})
                              .disc(176, 240, 24, {190, 40, 40})
                              .disc(464, 240, 24, {190, 40, 40})
                              .noise(4, seed);
    const geometry::Pixel winner = saliency.examine(canvas.view(), context).peak_px;
    if (context.previous_winner_px && (winner - *context.previous_winner_px).norm() > 100.0)
      ++flips;
    context.previous_winner_px = winner;
  }
  return flips;
}

class HysteresisOf : public testing::TestWithParam<SaliencyProfile> {};

INSTANTIATE_TEST_SUITE_P(Profiles, HysteresisOf,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust),
                         [](const auto& profile) {
                           return profile.param == SaliencyProfile::report ? "report" : "robust";
                         });

TEST_P(HysteresisOf, NoiseFlipsTheWinnerBetweenTwinsOnlyWithoutIt) {
  EXPECT_GE(flips_among_twins(with_hysteresis(GetParam(), 0.0)), 3);
  EXPECT_EQ(flips_among_twins(with_hysteresis(GetParam(), 0.2)), 0);
}

TEST_P(HysteresisOf, AStrongerRivalTakesOver) {
  Saliency saliency(with_hysteresis(GetParam(), 0.2), 640, 480);
  Canvas canvas = Canvas(640, 480, {205, 205, 195}).disc(176, 240, 20, {190, 150, 140});
  FrameContext context;
  context.previous_winner_px = saliency.examine(canvas.view(), context).peak_px;
  constexpr double same_place_px = 16.0;
  ASSERT_LE((*context.previous_winner_px - geometry::Pixel(176, 240)).norm(), same_place_px);
  canvas.disc(464, 240, 24, {190, 30, 30});
  EXPECT_LE((saliency.examine(canvas.view(), context).peak_px - geometry::Pixel(464, 240)).norm(),
            same_place_px);
}

TEST_P(HysteresisOf, ATargetThatMovesIsFollowedPastATwin) {
  Saliency saliency(with_hysteresis(GetParam(), 0.2), 640, 480);
  constexpr double followed_px = 20.0;  // a cell and some noise
  FrameContext context{.previous_winner_px = geometry::Pixel(120, 160)};
  for (int frame = 0; frame < 30; ++frame) {
    const int x = 120 + 6 * frame, y = 160 + 2 * frame;
    const Canvas canvas = Canvas(640, 480, {205, 205, 195})
                              .disc(464, 400, 24, {190, 40, 40})
                              .disc(x, y, 24, {190, 40, 40})
                              .noise(2, static_cast<std::uint64_t>(frame));
    const geometry::Pixel winner = saliency.examine(canvas.view(), context).peak_px;
    ASSERT_LE((winner - geometry::Pixel(x, y)).norm(), followed_px) << "in frame " << frame;
    context.previous_winner_px = winner;
  }
}

TEST(Hysteresis, TheMapIsTheSame) {
  const auto all = frames::drawn_frames();
  const base::ImageView frame = all[3].canvas.view();
  Saliency without(with_hysteresis(SaliencyProfile::robust, 0.0), 640, 480);
  Saliency with(with_hysteresis(SaliencyProfile::robust, 0.2), 640, 480);
  const SaliencyMap a = without.examine(frame).map;
  const SaliencyMap b = with.examine(frame, {.previous_winner_px = geometry::Pixel(100, 100)}).map;
  EXPECT_TRUE(std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end()));
}

}  // namespace
}  // namespace gazed::saliency::hysteresis_test
