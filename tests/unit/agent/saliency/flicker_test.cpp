// What changes while the head is still stands out, if it is told to.
#include "agent/saliency/flicker.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <utility>
#include <vector>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/comparison.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/grid.hpp"

namespace gazed::saliency::flicker_test {
namespace {

using frames::Canvas;

const FrameContext still{.head_is_still = true};

SaliencySettings settings_of(SaliencyProfile profile, double weight) {
  SaliencySettings settings;
  settings.profile = profile;
  settings.flicker_weight = weight;
  return settings;
}

std::vector<std::uint16_t> samples_of(const SaliencyMap& map) {
  return {map.samples.begin(), map.samples.end()};
}

// 24 discs alike on a regular grid; `odd` is moved or has another grey.
geometry::Pixel place(int i) {
  return {53 + i % 6 * 107, 60 + i / 6 * 120};
}

Canvas crowd(int odd, int moved_px, std::uint8_t odd_grey, std::uint64_t seed) {
  Canvas canvas(640, 480, frames::grey);
  for (int i = 0; i < 24; ++i) {
    const auto x = static_cast<int>(place(i).x()) + (i == odd ? moved_px : 0);
    const std::uint8_t level = i == odd ? odd_grey : 80;
    canvas.disc(x, static_cast<int>(place(i).y()), 14, {level, level, level});
  }
  return canvas.noise(2, seed);
}

class FlickerOf : public testing::TestWithParam<SaliencyProfile> {
 protected:
  /// Looks at two frames and gives the second's result.
  static SaliencyResult second(Saliency& saliency, const Canvas& first, const Canvas& then,
                               const FrameContext& context) {
    (void)saliency.examine(first.view(), still);
    return saliency.examine(then.view(), context);
  }
};

INSTANTIATE_TEST_SUITE_P(Profiles, FlickerOf,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust),
                         profile_name);

constexpr double found_px = 40.0;  // of the pop-out displays

TEST_P(FlickerOf, TheOneThatMovesAmongManyAlikeIsFound) {
  Saliency with(settings_of(GetParam(), 1.0), 640, 480);
  for (const int odd : {0, 8, 22}) {
    for (const int moved_px : {4, 12, 28}) {
      const SaliencyResult seen =
          second(with, crowd(odd, 0, 80, 1), crowd(odd, moved_px, 80, 2), still);
      EXPECT_LE((seen.peak_px - place(odd)).norm(), found_px)
          << "item " << odd << " moved by " << moved_px;
    }
  }
}

TEST_P(FlickerOf, TheOneThatBlinksAmongManyAlikeIsFound) {
  Saliency with(settings_of(GetParam(), 1.0), 640, 480);
  for (const int odd : {1, 9, 17, 23}) {
    const Canvas on = crowd(odd, 0, 80, 1), off = crowd(odd, 0, 110, 2);
    EXPECT_LE((second(with, on, off, still).peak_px - place(odd)).norm(), found_px);
    EXPECT_LE((second(with, off, on, still).peak_px - place(odd)).norm(), found_px);
  }
}

TEST_P(FlickerOf, WithoutItTheOneThatMovesIsNotFound) {
  Saliency without(settings_of(GetParam(), 0.0), 640, 480);
  int found = 0;
  for (const int odd : {0, 5, 8, 15, 22}) {
    const SaliencyResult seen = second(without, crowd(odd, 0, 80, 1), crowd(odd, 4, 80, 2), still);
    if ((seen.peak_px - place(odd)).norm() <= found_px) ++found;
  }
  EXPECT_LE(found, 2);
}

TEST_P(FlickerOf, AHeadThatMovedAndAFirstFrameChangeNoBit) {
  const Canvas first = crowd(8, 0, 80, 1), then = crowd(8, 12, 80, 2);
  Saliency with(settings_of(GetParam(), 1.0), 640, 480);
  Saliency without(settings_of(GetParam(), 0.0), 640, 480);
  EXPECT_EQ(samples_of(with.examine(first.view(), still).map),
            samples_of(without.examine(first.view(), still).map));
  EXPECT_EQ(samples_of(with.examine(then.view()).map),
            samples_of(without.examine(then.view()).map));
}

TEST_P(FlickerOf, AfterAMoveItComparesWithTheFrameAfterTheMove) {
  const Canvas before = crowd(8, 0, 80, 1), after = crowd(15, 12, 80, 2),
               later = crowd(15, 24, 80, 3);
  Saliency saliency(settings_of(GetParam(), 1.0), 640, 480);
  (void)saliency.examine(before.view());
  (void)saliency.examine(after.view());
  EXPECT_LE((saliency.examine(later.view(), still).peak_px - place(15)).norm(), found_px);
}

TEST_P(FlickerOf, ASceneThatStandsStillKeepsItsWinner) {
  const auto draw = [](std::uint64_t seed) {
    return Canvas(640, 480, {205, 205, 195}).disc(180, 330, 30, {200, 30, 30}).noise(4, seed);
  };
  Saliency with(settings_of(GetParam(), 1.0), 640, 480);
  Saliency without(settings_of(GetParam(), 0.0), 640, 480);
  for (std::uint64_t seed = 2; seed <= 4; ++seed) {
    const auto a = second(with, draw(1), draw(seed), still);
    const auto b = without.examine(draw(seed).view());
    constexpr double rounding_px = 0.01;  // S is scaled by 2/3
    EXPECT_LE((a.peak_px - b.peak_px).norm(), rounding_px);
    // Noise has no say, but a third of S is flicker's; the share is Q14.
    EXPECT_NEAR(a.saliency, b.saliency * 2 / 3, 1e-4F);
  }
}

// Noise of standard deviation 5.2 (amplitude 4) leaves less than half the floor.
TEST(Flicker, NoiseStaysBelowItsFloor) {
  SaliencySettings settings = settings_of(SaliencyProfile::robust, 1.0);
  settings.flicker_noise_floor /= 2;
  Saliency saliency(settings, 640, 480);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const SaliencyResult seen =
        saliency.examine(Canvas(640, 480, frames::grey).noise(4, seed).view(), still);
    EXPECT_EQ(seen.saliency, 0.0F);
  }
}

// The channel alone, on planes of its own level.

using PlaneOf = Grid<std::int16_t>;
using MapOf = Grid<std::int32_t>;

constexpr double third = 1.0 / 3.0;

TEST(Flicker, OneChangeIsWorthItsShareOf255) {
  Flicker flicker(0.25, 1, 640, 480);
  MapOf saliency(40, 30, 100 << 16);
  PlaneOf now(80, 60, 5000);
  flicker.add_to(saliency.plane(), now.plane(), true);
  now.at(20, 10) = 5800;
  flicker.add_to(saliency.plane(), now.plane(), true);
  // (1 - mean/M)^2 with one sample of 1200 changed: 0.17 % less than 1.
  constexpr double promotion = 0.0017 * (255 << 16);
  EXPECT_NEAR(saliency.at(10, 5), (100 << 16) * 3 / 4 + (255 << 16) / 4, promotion);
  EXPECT_EQ(saliency.at(30, 20), (100 << 16) * 3 / 4);
}

// The light is switched on and off again; all samples alike, those of the borders included.
TEST(Flicker, AChangeOfEverythingIsNone) {
  const std::int16_t white = 255 * samples_per_grey_level;
  for (const auto& [width, height] : {std::pair{640, 480}, {163, 127}, {161, 121}}) {
    Flicker flicker(third, 1, width, height);
    const int map_width = (width + 15) / 16, map_height = (height + 15) / 16;
    MapOf saliency(map_width, map_height);
    for (const std::int16_t value : {std::int16_t{0}, white, std::int16_t{0}}) {
      flicker.add_to(saliency.plane(), PlaneOf((width + 7) / 8, (height + 7) / 8, value).plane(),
                     true);
      for (int y = 0; y < map_height; ++y)
        for (int x = 0; x < map_width; ++x) ASSERT_EQ(saliency.at(x, y), 0);
    }
  }
}

// From black to white in one half: the largest sums that the filter meets.
TEST(Flicker, TheLargestChangeDoesNotOverflow) {
  const std::int16_t white = 255 * samples_per_grey_level;
  Flicker flicker(1.0, 1, 640, 480);
  MapOf saliency(40, 30);
  PlaneOf now(80, 60);
  flicker.add_to(saliency.plane(), now.plane(), true);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 39; ++x) now.at(x, y) = white;
  flicker.add_to(saliency.plane(), now.plane(), true);
  for (int x = 0; x < 40; ++x) {
    // A half is white, so (1 - mean/M)^2 is a quarter; three quarters of column 19's samples are.
    const double share = x < 19 ? 1.0 : (x == 19 ? 0.75 : 0.0);
    const double mean = 19.75 / 40;
    EXPECT_NEAR(saliency.at(x, 0) / 65536.0, 255 * share * (1 - mean) * (1 - mean), 0.1);
  }
}

TEST(Flicker, AChangeBelowTheFloorHasNoSay) {
  constexpr std::int16_t floor = 2 * samples_per_grey_level;
  for (const int change : {floor - 1, floor + 0}) {
    Flicker flicker(third, floor, 640, 480);
    MapOf saliency(40, 30);
    PlaneOf now(80, 60, 1000);
    flicker.add_to(saliency.plane(), now.plane(), true);
    for (int y = 9; y <= 11; ++y)
      for (int x = 19; x <= 21; ++x) now.at(x, y) = static_cast<std::int16_t>(1000 + change);
    flicker.add_to(saliency.plane(), now.plane(), true);
    EXPECT_EQ(saliency.at(10, 5) > 0, change == floor);
  }
}

}  // namespace
}  // namespace gazed::saliency::flicker_test
