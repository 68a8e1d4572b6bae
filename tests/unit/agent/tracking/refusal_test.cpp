// What the registration refuses, and that it says why.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <limits>
#include <stdexcept>
#include <string>

#include "agent/tracking/registration.hpp"

#include "rig.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::tracking::refusal_test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

constexpr double nan_rad = std::numeric_limits<double>::quiet_NaN();

class RefusalTest : public testing::Test {
 protected:
  void SetUp() override {
    first = expose(look(scene, {}), noisy, rig.random);
    ASSERT_TRUE(registration.choose_target(first.view(), scene.object_px + winner_error));
  }

  // What find() says of the scene `other` after look 1 at the scene.
  std::string reason(const Scene& other, geometry::HeadAngles head) {
    const Shot shot = expose(look(other, head), noisy, rig.random);
    const RegistrationResult result = registration.find(shot.view());
    EXPECT_FALSE(result.match) << "at " << result.match->pixel_2.transpose() << ", correlation "
                               << result.match->correlation;
    return result.reason;
  }

  Rig rig;
  const Capture noisy{.noise_levels = 2.0};
  const geometry::HeadAngles move = moves[0];
  const Scene scene = rig.scene(Object::disc, 30.0, 0.4, move);
  Registration registration = rig.registration();
  Shot first;
};

TEST_F(RefusalTest, OutOfView) {
  EXPECT_THAT(reason(scene, {0.9, 0.0}), HasSubstr("outside the image"));
  EXPECT_THAT(reason(scene, {2.0, 0.3}), HasSubstr("outside"));
}

// Its centre is just outside, the range unknown: whatever is found there must not be a match.
TEST_F(RefusalTest, LeavingTheView) {
  Scene near_border = scene;
  near_border.object_px = {560.0, 240.0};
  const Shot shot_1 = expose(look(near_border, {}), noisy, rig.random);
  ASSERT_TRUE(registration.choose_target(shot_1.view(), near_border.object_px));
  EXPECT_FALSE(reason(near_border, {0.16, 0.02}).empty());
}

TEST_F(RefusalTest, VanishedObject) {
  Scene empty = scene;
  empty.present = false;
  EXPECT_THAT(reason(empty, move), AnyOf(HasSubstr("nothing like"), HasSubstr("correlation")));
}

TEST_F(RefusalTest, VanishedBeforeATexturedWall) {
  Scene empty = scene;
  empty.present = false;
  empty.wall = [](double u, double v) {
    return Colour(Colour::Constant(60 + 150 * value_noise(u, v, 0.01, 11)));
  };
  EXPECT_THAT(reason(empty, move), HasSubstr("correlation"));
}

TEST_F(RefusalTest, AnotherColourInItsPlace) {
  for (const Colour& other : {Colour(30, 30, 200), Colour(30, 160, 30), Colour(60, 60, 60)}) {
    Scene swapped = scene;
    swapped.paint = [other](double, double) { return other; };
    EXPECT_THAT(reason(swapped, move),
                AnyOf(HasSubstr("another colour"), HasSubstr("correlation"), HasSubstr("contrast")))
        << other.transpose();
  }
}

TEST_F(RefusalTest, AnotherShapeInItsPlace) {
  Scene swapped = scene;
  swapped.paint = [size = scene.half_size_m](double u, double v) {
    return std::hypot(u, v) < 0.35 * size ? Colour(200, 30, 30) : Colour(200, 200, 200);
  };
  EXPECT_FALSE(reason(swapped, move).empty());
}

TEST_F(RefusalTest, RepeatedTexture) {
  Scene board = scene;
  board.present = false;
  // From parabolas: sines of every ray would take an emulated CPU the better part of a minute.
  const auto wave = [](double turns) {
    const double t = turns - std::floor(turns);
    return t < 0.5 ? 16.0 * t * (0.5 - t) : -16.0 * (t - 0.5) * (1.0 - t);
  };
  board.wall = [=](double u, double v) {
    constexpr double period_m = 0.01;  // 15 px at 0.4 m
    return Colour(Colour::Constant(120 + 11 * wave(u / period_m) + 11 * wave(v / period_m)));
  };
  const Shot shot_1 = expose(look(board, {}), noisy, rig.random);
  ASSERT_TRUE(registration.choose_target(shot_1.view(), board.object_px));
  EXPECT_THAT(reason(board, move), HasSubstr("ambiguous"));
}

TEST_F(RefusalTest, TwoEqualObjectsOnTheLine) {
  Scene twins = scene;
  const double apart = 3.0 * scene.half_size_m;
  twins.present = false;
  twins.wall = [=, size = scene.half_size_m](double u, double v) {
    const bool one = std::hypot(u, v) < size, other = std::hypot(u - apart, v) < size;
    return one || other ? Colour(200, 30, 30) : Colour(200, 200, 200);
  };
  const Shot shot_1 = expose(look(twins, {}), noisy, rig.random);
  ASSERT_TRUE(registration.choose_target(shot_1.view(), twins.object_px));
  // 90 px apart and the joints good to 1 mrad: only one of them can be it, unless it stands nearer.
  const Shot shot_2 = expose(look(twins, move), noisy, rig.random);
  const RegistrationResult result = registration.find(shot_2.view());
  if (result.match) {
    EXPECT_LT((result.match->pixel_2 - true_pixel_2(twins, move, twins.object_px)).norm(), 1.0);
  } else {
    EXPECT_THAT(result.reason, HasSubstr("ambiguous"));
  }
}

TEST_F(RefusalTest, BlankWallHasNoTarget) {
  Scene blank = scene;
  blank.present = false;
  const Radiance wall = look(blank, {});
  for (const double noise : {0.0, 2.0, 5.0}) {
    for (const base::PixelFormat format :
         {base::PixelFormat::rgb24, base::PixelFormat::yuyv, base::PixelFormat::grey}) {
      const Shot shot = expose(wall, {.noise_levels = noise, .format = format}, rig.random);
      EXPECT_FALSE(registration.choose_target(shot.view(), {320, 240})) << noise;
      EXPECT_THAT(registration.find(first.view()).reason, HasSubstr("no target"));
    }
  }
}

TEST_F(RefusalTest, AShadedBlankWallHasNoTarget) {
  Scene shaded = scene;
  shaded.present = false;
  shaded.wall = [](double u, double v) { return Colour(Colour::Constant(160 + 150 * u - 90 * v)); };
  const Shot shot = expose(look(shaded, {}), noisy, rig.random);
  EXPECT_FALSE(registration.choose_target(shot.view(), {320, 240}));
}

TEST_F(RefusalTest, AnglesThatAreNoAngles) {
  const Shot second = expose(look(scene, move), noisy, rig.random);
  geometry::View view = second.view();
  for (const geometry::HeadAngles bad :
       {geometry::HeadAngles{nan_rad, 0.1}, geometry::HeadAngles{0.1, nan_rad},
        geometry::HeadAngles{std::numeric_limits<double>::infinity(), 0.0}}) {
    view.head = bad;
    const RegistrationResult result = registration.find(view);
    EXPECT_FALSE(result.match);
    EXPECT_THAT(result.reason, HasSubstr("not finite"));
  }
  view.head = {1e12, -1e9};
  EXPECT_FALSE(registration.find(view).match);
  geometry::View view_1 = first.view();
  view_1.head = {nan_rad, 0.0};
  static_cast<void>(registration.choose_target(view_1, scene.object_px));
  EXPECT_THAT(registration.find(second.view()).reason, HasSubstr("not finite"));
}

TEST_F(RefusalTest, AbsurdPlacesHaveNoTarget) {
  for (const geometry::Pixel& bad : {geometry::Pixel(nan_rad, 1.0), geometry::Pixel(-1.0, 5.0),
                                     geometry::Pixel(640.0, 5.0), geometry::Pixel(1e300, -1e300)}) {
    EXPECT_FALSE(registration.choose_target(first.view(), bad));
  }
  for (const geometry::Pixel& corner : {geometry::Pixel(0, 0), geometry::Pixel(639, 479),
                                        geometry::Pixel(0, 479), geometry::Pixel(639, 0)}) {
    static_cast<void>(registration.choose_target(first.view(), corner));  // no crash
  }
}

TEST_F(RefusalTest, ImagesThatDoNotFit) {
  EXPECT_THAT(registration.find({}).reason, HasSubstr("0 x 0"));
  const base::Image small(320, 240, base::PixelFormat::rgb24);
  EXPECT_THAT(registration.find({small.view(), move, 0}).reason, HasSubstr("320 x 240"));
  const base::Image grey(640, 480, base::PixelFormat::grey);
  EXPECT_THAT(registration.find({grey.view(), move, 0}).reason, HasSubstr("format"));
  EXPECT_FALSE(registration.choose_target({small.view(), move, 0}, {100, 100}));
  EXPECT_THAT(registration.find(first.view()).reason, HasSubstr("no target"));
}

// Rectangles, noise and stripes of every format, any place and any move: a match, if there is one,
// is inside the frame with a covariance that is one.
TEST(RegistrationProperty, AnyImagesGiveAMatchThatIsOneOrAReason) {
  Rig rig;
  Registration registration = rig.registration();
  const auto below = [&](std::uint64_t n) { return static_cast<int>(rig.random.bits() % n); };
  const auto paint = [&](base::Image& image) {
    const int kind = below(3);
    for (std::uint8_t& byte : image.pixels()) {
      byte = kind == 0 ? static_cast<std::uint8_t>(rig.random.bits() >> 56) : std::uint8_t{128};
    }
    const auto pixel_bytes = image.pixels().size() / (640 * 480);
    for (int i = 0; kind > 0 && i < 12; ++i) {
      const int x = below(600), y = below(460), width = 1 + below(kind == 1 ? 200 : 8);
      for (int row = y; row < std::min(480, y + 1 + (kind == 1 ? width : 400)); ++row) {
        const auto bytes = pixel_bytes * static_cast<std::size_t>(std::min(width, 640 - x));
        std::fill_n(image.row(row) + pixel_bytes * static_cast<std::size_t>(x), bytes,
                    static_cast<std::uint8_t>(37 * i));
      }
    }
  };
  for (int trial = 0; trial < test::trials(150, 15); ++trial) {
    const auto format = static_cast<base::PixelFormat>(below(3));
    base::Image image_1(640, 480, format), image_2(640, 480, format);
    paint(image_1);
    if (below(2) == 0)
      paint(image_2);
    else
      image_2 = image_1;
    const geometry::HeadAngles head{0.01 * (below(120) - 60), 0.01 * (below(80) - 40)};
    const geometry::Pixel salient(below(640), below(480));
    const auto pixel_1 = registration.choose_target({image_1.view(), {}, 0}, salient);
    const RegistrationResult result = registration.find({image_2.view(), head, 0});
    if (!result.match) {
      EXPECT_FALSE(result.reason.empty());
      continue;
    }
    ASSERT_TRUE(pixel_1);
    EXPECT_TRUE(rig.robot.camera.contains(result.match->pixel_2));
    EXPECT_GT(result.match->covariance_px2.determinant(), 0.0);
    EXPECT_GT(result.match->covariance_px2.trace(), 0.0);
    EXPECT_GE(result.match->correlation, RegistrationSettings{}.correlation_min);
    EXPECT_TRUE(std::isfinite(result.match->scale));
  }
}

TEST(RegistrationSettings, OutOfRangeIsRefusedWithTheValue) {
  const Rig rig;
  const auto message = [&](const RegistrationSettings& settings) -> std::string {
    try {
      static_cast<void>(rig.registration(settings));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message({.range_min_m = 0.0}), HasSubstr("range_min_m is 0"));
  EXPECT_THAT(message({.range_min_m = nan_rad}), HasSubstr("range_min_m"));
  EXPECT_THAT(message({.range_min_m = 2.0, .range_max_m = 1.0}), HasSubstr("range_max_m is 1"));
  EXPECT_THAT(message({.correlation_min = 1.5}), HasSubstr("correlation_min is 1.5"));
  EXPECT_EQ(message({}), "accepted");
}

}  // namespace
}  // namespace gazed::tracking::refusal_test
