#include "drivers/sim/sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace gazed::sim::sensor_test {
namespace {

base::ImageView expose(Sensor& sensor, int width, int height, const auto& grey_at) {
  std::vector<Light> row(static_cast<std::size_t>(width) * 3U);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        row[static_cast<std::size_t>(3 * x + c)] = light_of(grey_at(x, y));
    sensor.add_row(row);
  }
  return sensor.finish();
}

TEST(Sensor, RoundsAndClips) {
  Sensor sensor(4, 2, {}, 1);
  const std::array<double, 4> grey{-5.0, 99.6, 255.4, 1000.0};
  const base::ImageView image =
      expose(sensor, 4, 2, [&](int x, int) { return grey[static_cast<std::size_t>(x)]; });
  EXPECT_EQ(image.row(1)[0], 0);
  EXPECT_EQ(image.row(1)[3], 100);
  EXPECT_EQ(image.row(1)[6], 255);
  EXPECT_EQ(image.row(1)[9], 255);
}

TEST(Sensor, NoiseHasTheSigmaAskedForAndDiffersFromFrameToFrame) {
  CameraBehaviour behaviour;
  behaviour.pixel_noise = 2.0;
  Sensor sensor(320, 240, behaviour, 7);
  constexpr int count = 320 * 240 * 3;
  // Five standard deviations of a standard deviation of `count` values, and rounding adds 1/12 to
  // the variance.
  constexpr double tolerance = 5.0 * 2.0 / 678.8;
  double before = 0.0;
  for (int frame = 0; frame < 2; ++frame) {
    const base::ImageView image = expose(sensor, 320, 240, [](int, int) { return 120.3; });
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < count; ++i) {
      sum += image.data[i];
      squares += static_cast<double>(image.data[i]) * image.data[i];
    }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 120.3, 5.0 * 2.0 / 480.0);
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean - 1.0 / 12.0), 2.0, tolerance);
    EXPECT_NE(sum, before);
    before = sum;
  }
}

TEST(Sensor, TheSameLightAgainHasNewNoiseOnly) {
  CameraBehaviour behaviour;
  behaviour.blur_sigma_px = 0.7;
  behaviour.pixel_noise = 2.0;
  Sensor once(16, 16, behaviour, 3), twice(16, 16, behaviour, 3);
  const auto copy = [](const base::ImageView& image) {
    return std::vector<std::uint8_t>(image.data, image.data + 16 * image.row_stride);
  };
  const auto slope = [](int, int y) { return 10.0 * y; };
  const auto first = copy(expose(once, 16, 16, slope)), again = copy(once.finish_again());
  EXPECT_EQ(first, copy(expose(twice, 16, 16, slope)));
  EXPECT_NE(first, again);
  EXPECT_EQ(again, copy(expose(twice, 16, 16, slope)));
}

TEST(Sensor, BlurIsAGaussianThatKeepsBrightnessAndBorders) {
  CameraBehaviour behaviour;
  behaviour.blur_sigma_px = 0.8;
  Sensor sensor(32, 24, behaviour, 1);
  const base::ImageView flat = expose(sensor, 32, 24, [](int, int) { return 200.0; });
  for (int i = 0; i < 32 * 24 * 3; ++i) ASSERT_EQ(flat.data[i], 200) << i;

  const base::ImageView point =
      expose(sensor, 32, 24, [](int x, int y) { return x == 10 && y == 12 ? 900.0 : 0.0; });
  const auto at = [&](int x, int y) { return static_cast<double>(point.row(y)[3 * x]); };
  constexpr double rounding = 1.0;
  const double ratio = std::exp(-0.5 / (0.8 * 0.8));
  EXPECT_NEAR(at(11, 12), ratio * at(10, 12), rounding);
  EXPECT_NEAR(at(10, 13), ratio * at(10, 12), rounding);
  EXPECT_EQ(at(9, 12), at(11, 12));
  EXPECT_EQ(at(10, 11), at(10, 13));
  double sum = 0.0;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) sum += at(x, y);
  EXPECT_NEAR(sum, 900.0, 16.0);
}

TEST(Sensor, ABlurWiderThanTheImage) {
  CameraBehaviour behaviour;
  behaviour.blur_sigma_px = 5.0;
  Sensor sensor(16, 16, behaviour, 1);
  const base::ImageView image = expose(sensor, 16, 16, [](int, int) { return 77.0; });
  for (int i = 0; i < 16 * 16 * 3; ++i) ASSERT_EQ(image.data[i], 77) << i;
}

TEST(Sensor, ExposureScalesBrightness) {
  CameraBehaviour behaviour;
  behaviour.exposure = 0.5;
  Sensor sensor(16, 16, behaviour, 1);
  EXPECT_EQ(expose(sensor, 16, 16, [](int, int) { return 120.0; }).data[100], 60);
}

TEST(Sensor, YuyvOfPrimaryColours) {
  CameraBehaviour behaviour;
  behaviour.format = base::PixelFormat::yuyv;
  Sensor sensor(2, 1, behaviour, 1);
  const auto yuyv = [&](std::array<int, 6> levels) {
    std::array<Light, 6> rgb;
    std::transform(levels.begin(), levels.end(), rgb.begin(),
                   [](int level) { return light_of(level); });
    sensor.add_row(rgb);
    const base::ImageView image = sensor.finish();
    EXPECT_EQ(image.format, base::PixelFormat::yuyv);
    return std::array<int, 4>{image.data[0], image.data[1], image.data[2], image.data[3]};
  };
  // ITU-R BT.601, the 100 % colour bars.
  EXPECT_EQ(yuyv({255, 255, 255, 0, 0, 0}), (std::array<int, 4>{235, 128, 16, 128}));
  EXPECT_EQ(yuyv({255, 0, 0, 255, 0, 0}), (std::array<int, 4>{81, 90, 81, 240}));
  EXPECT_EQ(yuyv({0, 0, 255, 0, 0, 255}), (std::array<int, 4>{41, 240, 41, 110}));
}

}  // namespace
}  // namespace gazed::sim::sensor_test
