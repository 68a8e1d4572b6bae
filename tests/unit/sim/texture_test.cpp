#include "drivers/sim/texture.hpp"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

namespace gazed {
namespace {

std::shared_ptr<const MipMap> ramp(int width, int height) {
  std::vector<std::int16_t> samples;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        samples.push_back(static_cast<std::int16_t>(x * static_cast<int>(MipMap::sample_scale)));
  return std::make_shared<const MipMap>(width, height, 3, false, std::move(samples));
}

TEST(MipMap, ARampIsTheSameRampOnEveryLevel) {
  constexpr float tolerance = 0.02F;  // samples are rounded to 1/64 on each level
  const auto map = ramp(64, 16);
  for (const float footprint : {0.0F, 1.0F, 1.5F, 2.0F, 4.0F}) {
    for (float x = 8.0F; x < 56.0F; x += 0.37F) {
      std::array<float, 3> rgb{};
      map->sample(x, 8.0F, footprint, rgb.data());
      EXPECT_NEAR(rgb[0], x - 0.5F, tolerance) << footprint << " " << x;
      EXPECT_EQ(rgb[0], rgb[2]);
    }
  }
}

TEST(MipMap, OddSizesAndSinglePixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {1, 7}, {5, 3}}) {
    const auto map = ramp(width, height);
    std::array<float, 3> rgb{};
    map->sample(-100.0F, 1e6F, 1e9F, rgb.data());
    EXPECT_TRUE(std::isfinite(rgb[0]));
    map->sample(0.5F, 0.5F, 0.0F, rgb.data());
    EXPECT_FLOAT_EQ(rgb[0], 0.0F);
  }
}

TEST(Noise, HasMeanNoughtAndTheContrastAskedFor) {
  for (const Pattern pattern : {Pattern::noise, Pattern::natural}) {
    Texture texture;
    texture.pattern = pattern;
    texture.colour = {100, 120, 140};
    texture.contrast = 10.0;
    texture.tile_m = 0.512;
    const TextureSampler sampler(texture, 1.0, 1.0, make_noise_tile(pattern, 5));
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int y = 0; y < 512; y += 2)
      for (int x = 0; x < 512; x += 2, ++count) {
        const auto rgb = sampler.sample(0.001F * (static_cast<float>(x) + 0.5F),
                                        0.001F * (static_cast<float>(y) + 0.5F), 0.0F);
        EXPECT_NEAR(rgb[2] - rgb[0], 40.0F, 1e-3F);
        sum += rgb[0];
        squares += static_cast<double>(rgb[0]) * rgb[0];
      }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 100.0, 0.5);
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 10.0, 0.5);
  }
}

TEST(Noise, SeedsDifferAndRepeat) {
  const auto value = [](std::uint32_t seed) {
    float sample = 0.0F;
    make_noise_tile(Pattern::natural, seed)->sample(100.5F, 33.5F, 0.0F, &sample);
    return sample;
  };
  EXPECT_EQ(value(1), value(1));
  EXPECT_NE(value(1), value(2));
}

TEST(Checker, CellsAndTheMeanFarAway) {
  Texture texture;
  texture.pattern = Pattern::checker;
  texture.colour = {200, 200, 200};
  texture.colour_2 = {0, 0, 0};
  texture.cell_m = 0.1;
  const TextureSampler sampler(texture, 1.0, 1.0, nullptr);
  EXPECT_NEAR(sampler.sample(0.05F, 0.05F, 0.001F)[0], 200.0F, 1e-3F);
  EXPECT_NEAR(sampler.sample(0.15F, 0.05F, 0.001F)[0], 0.0F, 1e-3F);
  EXPECT_NEAR(sampler.sample(-0.05F, 0.05F, 0.001F)[0], 0.0F, 1e-3F);
  EXPECT_NEAR(sampler.sample(-0.05F, -0.05F, 0.001F)[0], 200.0F, 1e-3F);
  EXPECT_NEAR(sampler.sample(0.1F, 0.05F, 0.02F)[0], 100.0F, 0.1F);  // on an edge
  EXPECT_NEAR(sampler.sample(0.33F, 0.41F, 2.0F)[0], 100.0F, 1.0F);  // ten cells a side in a pixel
}

TEST(Shading, GradientAndVignette) {
  Texture texture;
  texture.colour = {100, 100, 100};
  texture.gradient = {0.2, -0.1};
  texture.vignette = 0.5;
  const TextureSampler sampler(texture, 2.0, 1.0, nullptr);
  EXPECT_NEAR(sampler.sample(0.0F, 0.0F, 0.0F)[0], 100.0F, 1e-3F);
  EXPECT_NEAR(sampler.sample(2.0F, 1.0F, 0.0F)[0], 100.0F * (1.0F + 0.2F - 0.1F - 0.5F), 1e-3F);
  EXPECT_NEAR(sampler.sample(-2.0F, 0.0F, 0.0F)[0], 100.0F * (1.0F - 0.2F - 0.25F), 1e-3F);
}

}  // namespace
}  // namespace gazed
