// Surroundedness: against the definition, sample by sample; on displays; on photographs people
// looked at.
#include "agent/saliency/surroundedness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/row_ring.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/grid.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::saliency::surroundedness_test {
namespace {

using frames::Canvas;

constexpr int width = 80, height = 60;  // level 3 of 640x480

// N's weight is rounded down in Q24, S in Q16: a sample of up to 2^15 loses less than 2^7.
constexpr std::int32_t weight_rounding = 128;

struct Samples : Grid<std::int16_t> {
  Samples() : Grid(width, height) {}
  Samples& rectangle(int x, int y, int w, int h, int value) {
    for (int v = y; v < y + h; ++v)
      for (int u = x; u < x + w; ++u) at(u, v) = static_cast<std::int16_t>(value);
    return *this;
  }
};

/// Without the padding.
std::vector<std::int32_t> samples_of(const PlaneView<std::int32_t>& map) {
  std::vector<std::int32_t> samples;
  for (int y = 0; y < map.height; ++y)
    samples.insert(samples.end(), map.row(y), map.row(y) + map.width);
  return samples;
}

std::vector<std::int32_t> saliency_of(Samples plane, std::int32_t noise_floor = 1) {
  Surroundedness surroundedness(640, 480);
  surroundedness.begin();
  surroundedness.add(plane.plane(), noise_floor, 1.0);
  return samples_of(surroundedness.saliency());
}

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * width + x);
}

// What the border reaches, by the definition: no way out of a sample is higher than its lowest.
std::vector<double> reach_of(const std::vector<double>& heights) {
  std::vector<double> reach(heights.size());
  bool rose = true;
  while (rose) {
    rose = false;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool on_border = x == 0 || y == 0 || x == width - 1 || y == height - 1;
        const double inflow = on_border ? heights[at(x, y)]
                                        : std::max({reach[at(x - 1, y)], reach[at(x + 1, y)],
                                                    reach[at(x, y - 1)], reach[at(x, y + 1)]});
        const double reached = std::min(heights[at(x, y)], inflow);
        rose = rose || reached > reach[at(x, y)];
        reach[at(x, y)] = std::max(reach[at(x, y)], reached);
      }
    }
  }
  return reach;
}

std::vector<double> dilated(const std::vector<double>& in) {
  std::vector<double> out(in.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
          out[at(x, y)] = std::max(out[at(x, y)], in[at(u, v)]);
  return out;
}

// The definition in double precision, at level 3.
std::vector<double> defined(Samples plane, double lowest, double highest) {
  std::vector<double> sum(std::size_t{width} * height), heights = sum, share = sum;
  const double step = (highest - lowest) / Surroundedness::most_intervals;
  for (const bool upright : {true, false}) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        heights[at(x, y)] = (upright ? plane.at(x, y) - lowest : highest - plane.at(x, y)) / step;
    const std::vector<double> reach = reach_of(heights);
    for (int k = 0; k < Surroundedness::most_intervals; ++k) {
      for (std::size_t i = 0; i < sum.size(); ++i)
        share[i] = std::max(std::min(heights[i], k + 1.0) - std::max(reach[i], double(k)), 0.0);
      const std::vector<double> area = dilated(share);
      const double samples = std::accumulate(area.begin(), area.end(), 0.0);
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += area[i] / std::sqrt(std::max(samples, 1.0));
    }
  }
  return sum;
}

// By [1 4 6 4 1]/16 in both directions, borders reflected; every `step`-th sample.
std::vector<double> filtered(const std::vector<double>& in, int in_width, int in_height, int step) {
  constexpr std::array taps{1, 4, 6, 4, 1};
  std::vector<double> out;
  for (int y = 0; y < in_height; y += step) {
    for (int x = 0; x < in_width; x += step) {
      double sum = 0.0;
      for (int v = 0; v < 5; ++v)
        for (int u = 0; u < 5; ++u)
          sum += taps[static_cast<std::size_t>(v)] * taps[static_cast<std::size_t>(u)] *
                 in[static_cast<std::size_t>(in_width * reflect_101(y + v - 2, in_height) +
                                             reflect_101(x + u - 2, in_width))];
      out.push_back(sum / 256);
    }
  }
  return out;
}

TEST(Surroundedness, FollowsItsDefinition) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 5; ++round) {
    Samples plane = Samples().rectangle(0, 0, width, height, -100);
    for (int n = 0; n < 25; ++n)
      plane.rectangle(static_cast<int>(random() % 60), static_cast<int>(random() % 40),
                      1 + static_cast<int>(random() % 20), 1 + static_cast<int>(random() % 20),
                      100 * static_cast<int>(random() % 31) - 1500);
    plane.at(0, 0) = -1500;
    plane.at(0, 1) = 1500;
    const std::vector<double> expected = defined(plane, -1500, 1500);
    const auto found = saliency_of(plane);
    // Reduced and blurred by [1 4 6 4 1]; the maximum is 255.
    const std::vector<double> blurred =
        filtered(filtered(expected, width, height, 2), width / 2, height / 2, 1);
    const double largest = std::ranges::max(blurred);
    ASSERT_GT(largest, 0.0);
    // What each interval of a relief adds is rounded to a unit in 1024, and the sum once more where
    // it is reduced: one in 1/sqrt(4800) of them at worst, in the mean of 25 samples far less.
    const double rounding = 1.5 * 255 * (0.5 * 2 * Surroundedness::most_intervals + 0.5) / 1024;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double share = blurred[i] / largest;
      ASSERT_NEAR(found[i] / 65536.0, 255 * share * (share + 1) / 2, rounding / largest)
          << i % 40 << ',' << i / 40;
    }
  }
}

// A boolean map would be another where a threshold falls between.
TEST(Surroundedness, ALittleMoreOrLessChangesLittle) {
  const Samples plane = Samples().rectangle(20, 15, 30, 30, 4000).rectangle(30, 20, 8, 8, 6000);
  const auto before = saliency_of(plane);
  for (const int more : {1, 5, 20}) {
    Samples changed = plane;
    changed.rectangle(34, 24, 3, 3, 4000 + more).rectangle(38, 24, 12, 1, 4000 - more);
    Samples unchanged = plane;
    unchanged.rectangle(34, 24, 3, 3, 4000).rectangle(38, 24, 12, 1, 4000);
    const auto with = saliency_of(changed), without = saliency_of(unchanged);
    constexpr double per_level = 255.0 * 65536 / 500;  // an interval is 750
    for (std::size_t i = 0; i < with.size(); ++i)
      ASSERT_NEAR(with[i], without[i], per_level * more) << more;
  }
  EXPECT_EQ(before, saliency_of(plane));
}

TEST(Surroundedness, AFlatPlaneHasNone) {
  for (const std::int32_t sample : saliency_of(Samples())) EXPECT_EQ(sample, 0);
}

TEST(Surroundedness, WhatTouchesTheBorderIsNotSurrounded) {
  for (const std::int32_t sample : saliency_of(Samples().rectangle(0, 10, 30, 30, 5000)))
    EXPECT_EQ(sample, 0);
}

TEST(Surroundedness, BrightAndDarkAreAlike) {
  const auto bright = saliency_of(Samples().rectangle(30, 20, 8, 8, 5000));
  const auto dark = saliency_of(Samples().rectangle(30, 20, 8, 8, -5000));
  EXPECT_EQ(bright, dark);
  EXPECT_NEAR(std::ranges::max(bright), 255 << 16, weight_rounding);
  EXPECT_EQ(bright[12 * 40 + 17], std::ranges::max(bright));
}

TEST(Surroundedness, TheExtremesOfTheFormatDoNotOverflow) {
  Samples plane;
  plane.rectangle(0, 0, width, height, -largest_sample);
  plane.rectangle(30, 20, 1, 1, largest_sample);  // the smallest area, in every interval
  Surroundedness surroundedness(640, 480);
  surroundedness.begin();
  for (int i = 0; i < Surroundedness::most_planes; ++i) surroundedness.add(plane.plane(), 1, 1.0);
  const auto map = surroundedness.saliency();
  EXPECT_NEAR(map.row(10)[15], 255 << 16, weight_rounding);
  EXPECT_EQ(std::ranges::max(samples_of(map)), map.row(10)[15]);
  EXPECT_EQ(map.row(5)[5], 0);
}

TEST(Surroundedness, APlaneBelowTheNoiseFloorHasNoSay) {
  const Samples plane = Samples().rectangle(30, 20, 8, 8, 47);
  EXPECT_EQ(std::ranges::max(saliency_of(plane, 48)), 0);
  EXPECT_NEAR(std::ranges::max(saliency_of(plane, 47)), 255 << 16, weight_rounding);
}

// The profile.

SaliencySettings surround() {
  SaliencySettings settings;
  settings.profile = SaliencyProfile::surround;
  return settings;
}

TEST(SaliencySurround, ASmallDiscIsFoundWithin8Pixels) {
  Saliency saliency(surround(), 640, 480);
  for (const auto& [x, y] :
       {std::pair{320, 240}, {100, 100}, {133, 391}, {520, 77}, {571, 402}, {248, 200}}) {
    const Canvas canvas =
        Canvas(640, 480, {215, 215, 210}).disc(x, y, 12, {200, 30, 30}).noise(1, 1);
    const SaliencyResult seen = saliency.examine(canvas.view());
    EXPECT_LE((seen.peak_px - geometry::Pixel(x, y)).norm(), 8.0) << seen.peak_px.transpose();
    EXPECT_GE(static_cast<double>(seen.distinctness), surround().distinctness_min);
  }
}

// Of no other colour and no other brightness than the wall: only its print tells it.
TEST(SaliencySurround, APrintedThingOfTheWallsOwnGreyIsFound) {
  Canvas canvas(640, 480, {140, 140, 140});
  for (int y = 200; y < 280; y += 4)
    for (int x = 380; x < 460; x += 4)
      canvas.rectangle(
          x, y, 4, 4,
          (x + y) % 8 == 0 ? frames::Colour{180, 180, 180} : frames::Colour{100, 100, 100});
  const SaliencyResult seen = Saliency(surround(), 640, 480).examine(canvas.noise(2, 1).view());
  constexpr double on_it_px = 40.0;  // half of its side
  EXPECT_LE((seen.peak_px - geometry::Pixel(420, 240)).cwiseAbs().maxCoeff(), on_it_px)
      << seen.peak_px.transpose();
}

// It is surrounded by nothing: the centre-surround maps are asked.
TEST(SaliencySurround, WhatTheBorderCutsIsFoundWhereNothingWholeIs) {
  const Canvas cut =
      Canvas(640, 480, {220, 220, 215}).disc(320, 450, 60, {200, 30, 30}).noise(1, 1);
  Saliency saliency(surround(), 640, 480);
  const SaliencyResult seen = saliency.examine(cut.view());
  EXPECT_GE(static_cast<double>(seen.distinctness), surround().distinctness_min);
  EXPECT_LE((seen.peak_px - geometry::Pixel(320, 450)).norm(), 60.0) << seen.peak_px.transpose();
  const Canvas both = Canvas(640, 480, {220, 220, 215})
                          .disc(320, 450, 60, {200, 30, 30})
                          .disc(400, 200, 30, {30, 60, 170})
                          .noise(1, 1);
  EXPECT_LE((saliency.examine(both.view()).peak_px - geometry::Pixel(400, 200)).norm(), 30.0);
}

TEST(SaliencySurround, EmptyWallsAreNotDistinct) {
  Saliency saliency(surround(), 640, 480);
  for (const int percent : {15, 40, 70}) {
    for (std::uint64_t seed = 1; seed <= test::trials(4, 1); ++seed) {
      const Canvas shaded =
          Canvas(640, 480, {210, 205, 195}).shade_to_the_right(percent).noise(2, seed);
      const Canvas vignetted = Canvas(640, 480, {210, 205, 195}).vignette(percent).noise(2, seed);
      for (const Canvas& canvas : {shaded, vignetted})
        EXPECT_LT(static_cast<double>(saliency.examine(canvas.view()).distinctness),
                  surround().distinctness_min)
            << percent << " %, seed " << seed;
    }
  }
}

TEST(SaliencySurround, FramesOfEverySizeAreTaken) {
  for (const auto& [w, h] : {std::pair{160, 120}, {161, 121}, {499, 643}, {1281, 719}}) {
    const int x = w * 2 / 3, y = h / 3, radius = h / 16;
    const Canvas canvas = Canvas(w, h, {190, 195, 200}).disc(x, y, radius, {200, 40, 30});
    Saliency saliency(surround(), w, h);
    EXPECT_LE((saliency.examine(canvas.view()).peak_px - geometry::Pixel(x, y)).norm(), 12.0)
        << w << 'x' << h;
  }
}

// The same scene in more or fewer pixels.
TEST(SaliencySurround, DistinctnessDoesNotDependOnTheFramesSize) {
  const auto distinctness = [](int longer, bool upright) {
    const int w = upright ? longer * 3 / 4 : longer, h = upright ? longer : longer * 3 / 4;
    Canvas canvas(w, h, {190, 195, 200});
    for (int i = 0; i < 5; ++i)
      canvas.disc(w * (2 + 3 * i) / 17, h / 4, longer / 40, {150, 160, 90});
    canvas.disc(w * 2 / 3, h * 2 / 3, longer / 24, {200, 60, 50});
    return static_cast<double>(Saliency(surround(), w, h).examine(canvas.view()).distinctness);
  };
  constexpr double same = 0.1;  // the finer levels see more of the discs' rims
  for (const bool upright : {false, true}) {
    EXPECT_NEAR(distinctness(1280, upright), distinctness(640, false), same) << upright;
    EXPECT_NEAR(distinctness(640, upright), distinctness(640, false), same) << upright;
    EXPECT_NEAR(distinctness(320, upright), distinctness(640, false), same) << upright;
  }
}

TEST(SaliencySurround, WeightsChooseThePlanes) {
  const Canvas canvas = Canvas(640, 480, {150, 150, 150})
                            .disc(176, 240, 24, {230, 70, 150})
                            .disc(464, 240, 24, {100, 100, 250});
  SaliencySettings settings = surround();
  settings.intensity_weight = settings.blue_yellow_weight = 0.0;
  constexpr double same_place_px = 24.0;
  EXPECT_LE(
      (Saliency(settings, 640, 480).examine(canvas.view()).peak_px - geometry::Pixel(176, 240))
          .norm(),
      same_place_px);
}

}  // namespace
}  // namespace gazed::saliency::surroundedness_test
