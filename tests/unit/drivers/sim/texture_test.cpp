#include "drivers/sim/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "picture.hpp"

namespace gazed::sim::texture_test {
namespace {

using testing::look_up, testing::ramp;

/// Grey levels.
std::array<float, 3> grey_at(const TextureSampler& sampler, double u_m, double v_m,
                             float footprint_m) {
  const std::array<Light, 3> rgb = sampler.sample({u_m, v_m}, footprint_m);
  return {levels_of(rgb[0]), levels_of(rgb[1]), levels_of(rgb[2])};
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
        const auto rgb = grey_at(sampler, 0.001 * (x + 0.5), 0.001 * (y + 0.5), 0.0F);
        EXPECT_NEAR(rgb[2] - rgb[0], 40.0F, 1e-3F);
        sum += rgb[0];
        squares += static_cast<double>(rgb[0]) * rgb[0];
      }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 100.0, 0.5);
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 10.0, 0.5);
  }
}

TEST(Noise, ACollageHasColoursOfTheContrastAskedFor) {
  Texture texture;
  texture.pattern = Pattern::collage;
  texture.colour = {120, 120, 120};
  texture.contrast = 12.0;
  texture.tile_m = 0.512;
  const TextureSampler sampler(texture, 1.0, 1.0, make_noise_tile(Pattern::collage, 5));
  std::array<double, 3> sum{};
  double squares = 0.0, products = 0.0;
  int count = 0;
  for (int y = 0; y < 512; y += 2)
    for (int x = 0; x < 512; x += 2, ++count) {
      const auto rgb = grey_at(sampler, 0.001 * (x + 0.5), 0.001 * (y + 0.5), 0.0F);
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += rgb[c] - 120.0;
        squares += (rgb[c] - 120.0) * (rgb[c] - 120.0);
        products += (rgb[c] - 120.0) * (rgb[(c + 1) % 3] - 120.0);
      }
    }
  // Few leaves are large, and their levels do not average out: a third of the contrast.
  for (const double channel : sum) EXPECT_NEAR(channel / count, 0.0, 4.0);
  EXPECT_NEAR(std::sqrt(squares / (3 * count)), 12.0, 0.5);
  EXPECT_NEAR(products / squares, 0.5, 0.15);  // half of it is common brightness
}

TEST(Noise, SeedsDifferAndRepeat) {
  const auto value = [](std::uint32_t seed) {
    return testing::look_up(*make_noise_tile(Pattern::natural, seed), 100.5, 33.5, 0.0F)[0];
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
      const float value =
          testing::look_up(tile, static_cast<double>(x), static_cast<double>(y), footprint)[0];
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
  for (double y = 0.5; y < 512.0; y += 1.0)
    for (double x = 0.5; x < 511.0; x += 1.0, ++count) {
      const float left = testing::look_up(*tile, x, y, 0.0F)[0],
                  right = testing::look_up(*tile, x + 1.0, y, 0.0F)[0];
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
  // Up to 100 over a frame of 640 x 480 are used: here half of them on a quarter of it,
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
        grey.push_back(static_cast<double>(grey_at(sampler, 0.001 * x, 0.001 * y, 0.001F)[0]));
    EXPECT_GT(corners(grey, width, height, 10.0 * noise), wanted) << static_cast<int>(pattern);
  }
}

/// Light and black squares.
TextureSampler checker(double cell_m) {
  Texture texture;
  texture.pattern = Pattern::checker;
  texture.colour = {200, 200, 200};
  texture.colour_2 = {0, 0, 0};
  texture.cell_m = cell_m;
  return {texture, 1.0, 1.0, nullptr};
}

TEST(Checker, CellsAndTheMeanFarAway) {
  const TextureSampler sampler = checker(0.1);
  EXPECT_NEAR(grey_at(sampler, 0.05, 0.05, 0.001F)[0], 200.0F, 1e-3F);
  EXPECT_NEAR(grey_at(sampler, 0.15, 0.05, 0.001F)[0], 0.0F, 1e-3F);
  EXPECT_NEAR(grey_at(sampler, -0.05, 0.05, 0.001F)[0], 0.0F, 1e-3F);
  EXPECT_NEAR(grey_at(sampler, -0.05, -0.05, 0.001F)[0], 200.0F, 1e-3F);
  EXPECT_NEAR(grey_at(sampler, 0.1, 0.05, 0.02F)[0], 100.0F, 0.1F);  // on an edge
  EXPECT_NEAR(grey_at(sampler, 0.33, 0.41, 2.0F)[0], 100.0F, 1.0F);  // ten cells a side in a pixel
}

TEST(Checker, AnEdgeIsAPixelWideHoweverLargeTheCell) {
  const TextureSampler sampler = checker(0.2);
  constexpr double pixel_m = 0.2 / 500;
  constexpr auto footprint_m = static_cast<float>(pixel_m);
  constexpr float step = 200.0F / 65;  // Q16 places in a thousandth of a cell
  EXPECT_NEAR(grey_at(sampler, 0.2 - 0.6 * pixel_m, 0.1, footprint_m)[0], 200.0F, step);
  EXPECT_NEAR(grey_at(sampler, 0.2 - 0.25 * pixel_m, 0.1, footprint_m)[0], 150.0F, step);
  EXPECT_NEAR(grey_at(sampler, 0.2 + 0.25 * pixel_m, 0.1, footprint_m)[0], 50.0F, step);
  EXPECT_NEAR(grey_at(sampler, 0.2 + 0.6 * pixel_m, 0.1, footprint_m)[0], 0.0F, step);
}

TEST(TextureSampler, AnyFootprintHasAColour) {
  for (const Pattern pattern : {Pattern::solid, Pattern::checker, Pattern::noise, Pattern::natural,
                                Pattern::leaves, Pattern::image}) {
    Texture texture;
    texture.pattern = pattern;
    texture.colour = {128, 128, 128};
    texture.colour_2 = {10, 10, 10};
    texture.image = testing::ramp(64, 64);
    const TextureSampler sampler(texture, 0.5, 0.4,
                                 is_tiled(pattern) ? make_noise_tile(pattern, 2) : nullptr);
    for (const float footprint_m : {0.0F, 1e30F, std::numeric_limits<float>::infinity(),
                                    std::numeric_limits<float>::quiet_NaN()}) {
      const float grey = grey_at(sampler, 0.123, -0.2, footprint_m)[0];
      EXPECT_TRUE(grey >= 0.0F && grey <= 255.0F) << static_cast<int>(pattern) << ": " << grey;
    }
  }
}

TEST(TextureSampler, ARunShowsWhatItsPixelsWouldAlone) {
  // Along a straight line on the surface nothing is left to the quadratic: rounding alone.
  constexpr float tolerance = 2.0F / (1 << light_fraction_bits);
  constexpr int pixels = TextureSampler::longest_run_px;
  for (const Pattern pattern :
       {Pattern::solid, Pattern::checker, Pattern::natural, Pattern::image}) {
    Texture texture;
    texture.pattern = pattern;
    texture.gradient = {0.3, -0.2};
    texture.vignette = 0.1;
    texture.image = testing::ramp(64, 64);
    const TextureSampler sampler(texture, 0.5, 0.4, make_noise_tile(Pattern::natural, 2));
    for (const int count : {1, 2, 3, 7, pixels}) {
      const auto at = [](int i) { return SurfacePoint{-0.2 + 0.011 * i, 0.1 - 0.007 * i}; };
      std::vector<Light> run(3 * static_cast<std::size_t>(count));
      sampler.sample(at(0), at((count - 1) / 2), at(count - 1), 0.004F, run);
      for (int i = 0; i < count; ++i) {
        const std::array<Light, 3> alone = sampler.sample(at(i), 0.004F);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(levels_of(run[3 * static_cast<std::size_t>(i) + c]), levels_of(alone[c]),
                      tolerance)
              << static_cast<int>(pattern) << ", pixel " << i << " of " << count;
      }
    }
  }
}

TEST(Shading, GradientAndVignette) {
  Texture texture;
  texture.colour = {100, 100, 100};
  texture.gradient = {0.2, -0.1};
  texture.vignette = 0.5;
  const TextureSampler sampler(texture, 2.0, 1.0, nullptr);
  EXPECT_NEAR(grey_at(sampler, 0.0, 0.0, 0.0F)[0], 100.0F, 1e-3F);
  EXPECT_NEAR(grey_at(sampler, 2.0, 1.0, 0.0F)[0], 100.0F * (1.0F + 0.2F - 0.1F - 0.5F), 1e-3F);
  EXPECT_NEAR(grey_at(sampler, -2.0, 0.0, 0.0F)[0], 100.0F * (1.0F - 0.2F - 0.25F), 1e-3F);
}

}  // namespace
}  // namespace gazed::sim::texture_test
