#include "agent/tracking/plane.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <gmock/gmock.h>
#include <random>

namespace gazed::tracking::plane_test {
namespace {

using testing::FloatNear;

// Values up to 255 in single precision, a few dozen additions.
constexpr float rounding = 1e-3F;

base::Image ramp(base::PixelFormat format, int width, int height) {
  base::Image image(width, height, format);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * base::bytes_per_pixel(format); ++x) {
      image.row(y)[x] = static_cast<std::uint8_t>(2 * (x / base::bytes_per_pixel(format)) + y);
    }
  }
  return image;
}

TEST(Plane, ReadsARampExactlyAtEveryLevelAndPlace) {
  const base::Image image = ramp(base::PixelFormat::rgb24, 64, 48);
  PlanePyramid planes;
  planes.build(image.view(), Eigen::Vector3f::Constant(1.0F / 3.0F), {0, 0, 64, 48}, 3);
  for (int level = 0; level < 3; ++level) {
    const PlaneLevel& plane = planes.level(level);
    for (const geometry::Pixel& pixel : {geometry::Pixel(24.0, 20.0), geometry::Pixel(30.25, 25.7),
                                         geometry::Pixel(31.99, 22.01)}) {
      const Eigen::Vector2d at = plane.to_samples(pixel);
      ASSERT_TRUE(plane.readable(at));
      const PlaneSample read = plane.read(at);
      const auto step = static_cast<float>(plane.step_px);
      EXPECT_THAT(read.value, FloatNear(static_cast<float>(2 * pixel.x() + pixel.y()), rounding));
      EXPECT_THAT(read.dx, FloatNear(2.0F * step, rounding));
      EXPECT_THAT(read.dy, FloatNear(step, rounding));
    }
  }
}

TEST(Plane, SlopesAreThoseOfTheValues) {
  base::Image image(32, 32, base::PixelFormat::grey);
  std::mt19937_64 random(3);
  for (std::uint8_t& pixel : image.pixels()) pixel = static_cast<std::uint8_t>(random() >> 56);
  PlanePyramid planes;
  planes.build(image.view(), Eigen::Vector3f::UnitX(), {0, 0, 32, 32}, 1);
  const PlaneLevel& plane = planes.level(0);
  constexpr double step = 1e-2;
  constexpr float truncation = 0.02F;  // third derivatives of white noise times step^2
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d at(4.0 + 0.47 * i, 27.0 - 0.43 * i);
    const auto value = [&](double dx, double dy) {
      return static_cast<double>(plane.read(at + Eigen::Vector2d(dx, dy)).value);
    };
    const PlaneSample read = plane.read(at);
    EXPECT_THAT(
        read.dx,
        FloatNear(static_cast<float>((value(step, 0) - value(-step, 0)) / (2 * step)), truncation));
    EXPECT_THAT(
        read.dy,
        FloatNear(static_cast<float>((value(0, step) - value(0, -step)) / (2 * step)), truncation));
  }
}

TEST(Plane, RepeatsTheFramesBorderBeyondIt) {
  const base::Image image = ramp(base::PixelFormat::grey, 20, 16);
  PlanePyramid planes;
  planes.build(image.view(), Eigen::Vector3f::UnitX(), {-9, -7, 33, 28}, 2);
  const PlaneLevel& plane = planes.level(0);
  // Four pixels off, where neither smoothing nor reading sees the frame's inside.
  EXPECT_FLOAT_EQ(plane.read(plane.to_samples({-5.0, -5.0})).value, 0.0F);
  EXPECT_FLOAT_EQ(plane.read(plane.to_samples({25.0, 20.0})).value, 2 * 19 + 15);
}

// A search's samples beyond the border cost no projection and no filter, and are the same bits.
TEST(Plane, TheCoarsestLevelIsThatOfAFrameWithRepeatedBorders) {
  constexpr int width = 60, height = 44, border = 208, levels = 4;
  base::Image frame(width, height, base::PixelFormat::rgb24);
  std::mt19937_64 random(5);
  for (std::uint8_t& byte : frame.pixels()) byte = static_cast<std::uint8_t>(random() >> 56);
  base::Image padded(width + 2 * border, height + 2 * border, base::PixelFormat::rgb24);
  for (int y = 0; y < height + 2 * border; ++y) {
    for (int x = 0; x < width + 2 * border; ++x) {
      const std::uint8_t* from = frame.row(std::clamp(y - border, 0, height - 1)) +
                                 3 * std::clamp(x - border, 0, width - 1);
      std::copy(from, from + 3, padded.row(y) + 3 * x);
    }
  }
  const Eigen::Vector3f axis(0.5F, -0.7F, 0.3F);
  // All of it, a corner, a part inside, and one that ends between the border and what is repeated.
  for (const PixelBox region : {PixelBox{-150, -140, 200, 190}, PixelBox{-90, -100, 30, 20},
                                PixelBox{8, 16, 40, 32}, PixelBox{-20, 3, 75, 150}}) {
    PlanePyramid planes, expected;
    planes.build(frame.view(), axis, region, levels);
    expected.build(padded.view(), axis,
                   {region.x_begin + border, region.y_begin + border, region.x_end + border,
                    region.y_end + border},
                   levels);
    const PlaneLevel &found = planes.level(levels - 1), &whole = expected.level(levels - 1);
    ASSERT_EQ(found.width, whole.width);
    ASSERT_EQ(found.height, whole.height);
    ASSERT_EQ(found.origin_px.x(), whole.origin_px.x() - border);
    ASSERT_EQ(found.origin_px.y(), whole.origin_px.y() - border);
    // The outer two of `whole` know that its region ends there.
    for (int y = 2; y < whole.height - 2; ++y) {
      for (int x = 2; x < whole.width - 2; ++x) {
        ASSERT_EQ(found.row(y)[x], whole.row(y)[x]) << x << ", " << y;
      }
    }
  }
}

TEST(Plane, ARegionWhollyOutsideTheFrameIsItsCorner) {
  const base::Image image = ramp(base::PixelFormat::grey, 20, 16);
  PlanePyramid planes;
  planes.build(image.view(), Eigen::Vector3f::UnitX(), {40, 40, 56, 56}, 1);
  EXPECT_FLOAT_EQ(planes.level(0).read({8.0, 8.0}).value, 2 * 19 + 15);
  planes.build(image.view(), Eigen::Vector3f::UnitX(), {-56, -56, -40, -40}, 1);
  EXPECT_FLOAT_EQ(planes.level(0).read({8.0, 8.0}).value, 0.0F);
}

// A chroma ramp of 4 levels a pair is 2 levels a pixel, each pair's value half way between its
// pixels.
TEST(Plane, InterpolatesTheChromaOfYuyv) {
  base::Image image(32, 16, base::PixelFormat::yuyv);
  for (int y = 0; y < 16; ++y) {
    for (int pair = 0; pair < 16; ++pair) {
      std::uint8_t* bytes = image.row(y) + 4 * pair;
      bytes[0] = bytes[2] = 100;
      bytes[1] = static_cast<std::uint8_t>(50 + 4 * pair);
      bytes[3] = 128;
    }
  }
  PlanePyramid planes;
  planes.build(image.view(), Eigen::Vector3f::UnitY(), {0, 0, 32, 16}, 1);
  EXPECT_THAT(planes.level(0).read({16.5, 8.0}).value, FloatNear(50.0F + 4 * 8, rounding));
  EXPECT_THAT(planes.level(0).read({11.0, 8.0}).value, FloatNear(50.0F + 4 * 5 + 1, rounding));
}

}  // namespace
}  // namespace gazed::tracking::plane_test
