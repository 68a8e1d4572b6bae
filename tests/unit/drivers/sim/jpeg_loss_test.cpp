#include "drivers/sim/jpeg_loss.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

#include "drivers/sim/sensor.hpp"

namespace gazed::sim::jpeg_loss_test {
namespace {

JpegLoss::Block even(std::int32_t level) {
  JpegLoss::Block block;
  block.fill(level);
  return block;
}

TEST(JpegLoss, StepsAreLibjpegs) {
  // 16, 11, 10 of table K.1 at 50; by (100 - quality) / 50, rounded, above; by 50 / quality below.
  EXPECT_EQ(JpegLoss(50).luma_steps()[0], 16);
  EXPECT_EQ(JpegLoss(75).luma_steps()[0], 8);
  EXPECT_EQ(JpegLoss(75).luma_steps()[1], 6);
  EXPECT_EQ(JpegLoss(60).luma_steps()[0], 13);
  EXPECT_EQ(JpegLoss(25).chroma_steps()[0], 34);
  EXPECT_EQ(JpegLoss(100).chroma_steps()[63], 1);
}

TEST(JpegLoss, AnEvenBlockKeepsTheNearestLevelThatItCanHave) {
  // Its only coefficient is 8 (level - 128), rounded to a multiple of 13: off 128 by
  // 0, 1.625, 3.25, 4.875.
  const JpegLoss loss(60);
  for (const auto& [level, kept] :
       {std::pair{128, 128}, {129, 130}, {131, 131}, {133, 133}, {127, 126}, {125, 125}}) {
    JpegLoss::Block block = even(level);
    loss.degrade(block, loss.luma_steps());
    EXPECT_EQ(block, even(kept)) << level;
  }
}

TEST(JpegLoss, ACosineKeepsAMultipleOfItsStep) {
  // 10 cos((2 x + 1) pi / 16) down all rows has the coefficient 10 x 8 / sqrt(2) = 56.57 at
  // frequency (1, 0), whose step is 11: 5 x 11 = 55 is left of it, an amplitude of 9.72.
  const JpegLoss loss(50);
  JpegLoss::Block block;
  for (std::size_t i = 0; i < block.size(); ++i)
    block[i] = 128 + static_cast<std::int32_t>(std::lround(
                         10.0 * std::cos((2.0 * (i % 8) + 1.0) * std::numbers::pi / 16.0)));
  loss.degrade(block, loss.luma_steps());
  for (std::size_t i = 0; i < block.size(); ++i)
    EXPECT_NEAR(block[i], 128.0 + 9.72 * std::cos((2.0 * (i % 8) + 1.0) * std::numbers::pi / 16.0),
                0.51);
}

TEST(JpegLoss, SomeNoiseIsLostAtAHighQualityAndMostAtALow) {
  const auto error = [](int quality) {
    const JpegLoss loss(quality);
    JpegLoss::Block block, before;
    std::uint32_t state = 1;
    for (std::int32_t& sample : before) {
      state = state * 1664525U + 1013904223U;
      sample = 120 + static_cast<std::int32_t>(state >> 28U);
    }
    block = before;
    loss.degrade(block, loss.luma_steps());
    double squares = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i)
      squares += (block[i] - before[i]) * (block[i] - before[i]);
    return std::sqrt(squares / static_cast<double>(block.size()));
  };
  EXPECT_LT(error(100), 0.6);
  EXPECT_GT(error(60), 2.0);
  EXPECT_LT(error(60), error(20));
}

TEST(JpegLoss, ASensorsPictureLosesOnlyWhatMjpegLoses) {
  CameraBehaviour behaviour;
  behaviour.format = base::PixelFormat::yuyv;
  Sensor whole(20, 12, behaviour, 1);
  behaviour.jpeg_quality = 90;
  Sensor lossy(20, 12, behaviour, 1);
  std::vector<Light> row(3U * 20U);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c)
        row[static_cast<std::size_t>(3 * x + c)] = light_of(60.0 + 5.0 * x + 4.0 * y + 20.0 * c);
    whole.add_row(row);
    lossy.add_row(row);
  }
  const base::ImageView a = whole.finish(), b = lossy.finish();
  int differ = 0;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 40; ++x) {
      EXPECT_LE(std::abs(a.row(y)[x] - b.row(y)[x]), 6);
      differ += a.row(y)[x] != b.row(y)[x] ? 1 : 0;
    }
  EXPECT_GT(differ, 20);
}

}  // namespace
}  // namespace gazed::sim::jpeg_loss_test
