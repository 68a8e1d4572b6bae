#include "drivers/sim/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <vector>

namespace gazed::texture_test {
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
  for (const Pattern pattern : {Pattern::noise, Pattern::natural, Pattern::leaves}) {
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

/// Of a tile as it is seen with pixels of so many samples.
double variance(const MipMap& tile, float footprint) {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (float y = 0.5F * footprint; y < 512.0F; y += footprint)
    for (float x = 0.5F * footprint; x < 512.0F; x += footprint, ++count) {
      float value = 0.0F;
      tile.sample(x, y, footprint, &value);
      sum += value;
      squares += static_cast<double>(value) * value;
    }
  const double mean = sum / count;
  return squares / count - mean * mean;
}

TEST(Noise, NaturalAndLeavesHaveAboutTheSameEnergyInEveryOctave) {
  // Amplitude 1/f is power 1/f^2, and its sum over the circle of an octave is the same for each.
  constexpr double most_uneven = 3.0;
  for (const Pattern pattern : {Pattern::natural, Pattern::leaves}) {
    const auto tile = make_noise_tile(pattern, 3);
    double least = 1e9, greatest = 0.0;
    for (const float samples : {2.0F, 4.0F, 8.0F, 16.0F, 32.0F}) {
      const double octave = variance(*tile, samples) - variance(*tile, 2.0F * samples);
      least = std::min(least, octave);
      greatest = std::max(greatest, octave);
    }
    EXPECT_LT(greatest / least, most_uneven) << static_cast<int>(pattern);
  }
}

TEST(Noise, LeavesHaveEdgesAndFlatPlacesBetweenThem) {
  const auto tile = make_noise_tile(Pattern::leaves, 3);
  const double sigma = std::sqrt(variance(*tile, 1.0F));
  int flat = 0, edges = 0, count = 0;
  for (float y = 0.5F; y < 512.0F; y += 1.0F)
    for (float x = 0.5F; x < 511.0F; x += 1.0F, ++count) {
      float left = 0.0F, right = 0.0F;
      tile->sample(x, y, 0.0F, &left);
      tile->sample(x + 1.0F, y, 0.0F, &right);
      const double step = std::abs(left - right) / sigma;
      if (step == 0.0) ++flat;
      if (step > 1.0) ++edges;
    }
  EXPECT_GT(flat, count / 2);
  EXPECT_GT(edges, count / 40);
}

/// Corners of Shi and Tomasi (1994): the lesser eigenvalue of the summed gradient products of a 5 x
/// 5 window, at least `least` and the greatest within 10 px.
int corners(const std::vector<double>& grey, int width, int height, double least) {
  const auto at = [&](int x, int y) { return grey[static_cast<std::size_t>(y * width + x)]; };
  std::vector<double> quality(grey.size());
  for (int y = 3; y < height - 3; ++y)
    for (int x = 3; x < width - 3; ++x) {
      double xx = 0.0, xy = 0.0, yy = 0.0;
      for (int v = y - 2; v <= y + 2; ++v)
        for (int u = x - 2; u <= x + 2; ++u) {
          const double gx = 0.5 * (at(u + 1, v) - at(u - 1, v));
          const double gy = 0.5 * (at(u, v + 1) - at(u, v - 1));
          xx += gx * gx;
          xy += gx * gy;
          yy += gy * gy;
        }
      quality[static_cast<std::size_t>(y * width + x)] =
          0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);
    }
  int found = 0;
  for (int y = 10; y < height - 10; ++y)
    for (int x = 10; x < width - 10; ++x) {
      const double here = quality[static_cast<std::size_t>(y * width + x)];
      bool greatest = here >= least;
      for (int v = y - 10; greatest && v <= y + 10; ++v)
        for (int u = x - 10; greatest && u <= x + 10; ++u)
          greatest = quality[static_cast<std::size_t>(v * width + u)] <= here;
      found += greatest ? 1 : 0;
    }
  return found;
}

TEST(Noise, NaturalAndLeavesHaveMoreCornersThanTheBackgroundNeeds) {
  // Up to 100 over a frame of 640 x 480 are used (SPEC 4): here half of them on a quarter of it,
  // and far above the noise: 2 grey levels make 25 x 2^2 / 2 = 50.
  constexpr double noise = 50.0;
  constexpr int wanted = 50, width = 320, height = 240;
  for (const Pattern pattern : {Pattern::natural, Pattern::leaves}) {
    Texture texture;
    texture.pattern = pattern;
    texture.contrast = 20.0;
    texture.tile_m = 0.512;
    const TextureSampler sampler(texture, 1.0, 1.0, make_noise_tile(pattern, 1));
    std::vector<double> grey;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        grey.push_back(static_cast<double>(sampler.sample(
            0.001F * static_cast<float>(x), 0.001F * static_cast<float>(y), 0.001F)[0]));
    EXPECT_GT(corners(grey, width, height, 10.0 * noise), wanted) << static_cast<int>(pattern);
  }
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
}  // namespace gazed::texture_test
