// A window is weakened, and what lies beside it is found.
#include "agent/saliency/overexposed.hpp"

#include <cstdint>
#include <gtest/gtest.h>

#include "agent/saliency/fixed.hpp"
#include "agent/saliency/saliency.hpp"

#include "tests/unit/agent/saliency/frames.hpp"
#include "tests/unit/agent/saliency/grid.hpp"
#include "tests/unit/agent/saliency/result_hash.hpp"

namespace gazed::saliency::overexposed_test {
namespace {

using frames::Canvas;

constexpr std::int16_t saturated = 250 * samples_per_grey_level;

TEST(Overexposed, TheSampleAndItsNeighboursAreWeakened) {
  Grid<std::int32_t> saliency(12, 9, 1000);
  Grid<std::int16_t> intensity(12, 9, 100 * samples_per_grey_level);
  intensity.at(4, 3) = saturated;
  Overexposed(0.25, 12, 9).weaken(saliency.plane(), intensity.plane());
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 12; ++x)
      EXPECT_EQ(saliency.at(x, y), x >= 3 && x <= 5 && y >= 2 && y <= 4 ? 250 : 1000)
          << x << " " << y;
}

TEST(Overexposed, TheFrameBeforeIsForgotten) {
  Grid<std::int32_t> saliency(12, 9, 1000);
  Grid<std::int16_t> bright(12, 9, saturated), dark(12, 9, saturated - 1);
  Overexposed dut(0.0, 12, 9);
  dut.weaken(saliency.plane(), bright.plane());
  EXPECT_EQ(saliency.at(6, 6), 0);
  saliency.at(6, 6) = 1000;
  dut.weaken(saliency.plane(), dark.plane());
  EXPECT_EQ(saliency.at(6, 6), 1000);
}

SaliencySettings weakened(double weight, SaliencyProfile profile = SaliencyProfile::surround) {
  SaliencySettings settings;
  settings.profile = profile;
  settings.overexposed_weight = weight;
  return settings;
}

/// A lamp's white disc and a cup.
Canvas room() {
  return Canvas(640, 480, {110, 108, 104})
      .disc(200, 150, 60, frames::white)
      .rectangle(430, 300, 44, 56, {150, 70, 60})
      .noise(1, 3);
}

bool on_cup(const geometry::Pixel& pixel) {
  return pixel.x() >= 430 && pixel.x() < 474 && pixel.y() >= 300 && pixel.y() < 356;
}

TEST(Overexposed, WithoutWeightAWindowIsNoObject) {
  for (const SaliencyProfile profile : {SaliencyProfile::robust, SaliencyProfile::surround}) {
    Saliency stage(weakened(0.0, profile), 640, 480);
    const geometry::Pixel winner = stage.examine(room().view()).peak_px;
    EXPECT_TRUE(on_cup(winner)) << winner.transpose();
  }
}

TEST(Overexposed, YuyvSaysTheSame) {
  const Canvas canvas = room();
  const auto bytes = frames::yuyv_of(canvas.view());
  Saliency stage(weakened(0.0), 640, 480);
  EXPECT_TRUE(on_cup(stage.examine(frames::yuyv_view(bytes, 640, 480)).peak_px));
}

TEST(Overexposed, AFrameThatIsNotHasTheSameBits) {
  const auto all = frames::drawn_frames();
  for (const frames::NamedFrame& frame : all) {
    const base::ImageView view = frame.canvas.view();
    Saliency without(weakened(0.0), view.width_px, view.height_px);
    Saliency with(weakened(1.0), view.width_px, view.height_px);
    EXPECT_EQ(hash_of(without.examine(view)), hash_of(with.examine(view))) << frame.name;
  }
}

TEST(Overexposed, TheReportsProfileKnowsNothingOfIt) {
  const Canvas canvas = room();
  Saliency without(weakened(0.0, SaliencyProfile::report), 640, 480);
  Saliency with(weakened(1.0, SaliencyProfile::report), 640, 480);
  EXPECT_EQ(hash_of(without.examine(canvas.view())), hash_of(with.examine(canvas.view())));
}

}  // namespace
}  // namespace gazed::saliency::overexposed_test
