// The weights of the channels: a channel of weight 0 is blind, the others follow the reference.
#include <algorithm>
#include <gtest/gtest.h>
#include <utility>

#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/comparison.hpp"
#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::saliency::weights_test {
namespace {

using frames::Canvas;

// As of DrawnFramesFollowTheReference in saliency_test.cpp, which says why not more.
constexpr double drawn_correlation_min = 0.99;

class WeightsOf : public testing::TestWithParam<SaliencyProfile> {
 protected:
  SaliencySettings settings = [] {
    SaliencySettings s;
    s.profile = GetParam();
    return s;
  }();
};

INSTANTIATE_TEST_SUITE_P(Profiles, WeightsOf,
                         testing::Values(SaliencyProfile::report, SaliencyProfile::robust),
                         profile_name);

TEST_P(WeightsOf, OfTheOpponentsFollowTheReference) {
  for (const auto& [red_green, blue_yellow] : {std::pair{3.0, 0.5}, {0.0, 2.0}, {1.0, 0.0}}) {
    if (test::few_trials && red_green < 3.0) break;
    settings.red_green_weight = red_green;
    settings.blue_yellow_weight = blue_yellow;
    for (const frames::NamedFrame& frame : frames::drawn_frames())
      EXPECT_GE(compare(frame.canvas.view(), settings).correlation, drawn_correlation_min)
          << frame.name << " with " << red_green << ", " << blue_yellow;
  }
}

TEST_P(WeightsOf, IntensityAloneAndColourAloneFollowTheReference) {
  for (const auto& [intensity, colour] : {std::pair{1.0, 0.0}, {0.0, 1.0}}) {
    settings.intensity_weight = intensity;
    settings.colour_weight = colour;
    for (const frames::NamedFrame& frame : frames::drawn_frames())
      EXPECT_GE(compare(frame.canvas.view(), settings).correlation, drawn_correlation_min)
          << frame.name << " with " << intensity << ", " << colour;
  }
}

TEST_P(WeightsOf, OnlyTheRatioOfTheOpponentsCounts) {
  const auto all = frames::drawn_frames();
  const base::ImageView frame = all[2].canvas.view();
  Saliency one(settings, 640, 480);
  settings.red_green_weight = settings.blue_yellow_weight = 7.5;
  Saliency other(settings, 640, 480);
  const SaliencyMap a = one.examine(frame).map, b = other.examine(frame).map;
  EXPECT_TRUE(std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end()));
}

// A red disc and a blue one, of the wall's intensity: each is seen by one opponent more than by the
// other.
TEST(WeightsRobust, DecideBetweenRedAndBlue) {
  const Canvas canvas = Canvas(640, 480, {150, 150, 150})
                            .disc(176, 240, 24, {230, 70, 150})
                            .disc(464, 240, 24, {100, 100, 250});
  constexpr double same_place_px = 24.0;
  SaliencySettings settings;
  settings.intensity_weight = 0.0;
  settings.blue_yellow_weight = 0.0;
  EXPECT_LE(
      (Saliency(settings, 640, 480).examine(canvas.view()).peak_px - geometry::Pixel(176, 240))
          .norm(),
      same_place_px);
  settings.blue_yellow_weight = 1.0;
  settings.red_green_weight = 0.0;
  EXPECT_LE(
      (Saliency(settings, 640, 480).examine(canvas.view()).peak_px - geometry::Pixel(464, 240))
          .norm(),
      same_place_px);
}

}  // namespace
}  // namespace gazed::saliency::weights_test
