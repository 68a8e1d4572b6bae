// Is pixel_2 right, and does its covariance say how right?

#include "agent/tracking/registration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <string>
#include <utility>

#include "registration_fixture.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::tracking::registration_test {
namespace {

TEST_F(RegistrationTest, EveryObjectAtEveryRange) {
  std::size_t turn = 0;
  for (const Object object : all_objects) {
    for (const double range_m : {0.2, 0.6, 2.0}) {
      const geometry::HeadAngles move = moves[turn++ % moves.size()];
      if (test::few_trials && turn % 4 != 1) continue;  // each range and move, four of the objects
      SCOPED_TRACE(testing::Message() << name(object) << " at " << range_m << " m, move ("
                                      << move.yaw_rad << ", " << move.pitch_rad << ")");
      const double half_size_px = object == Object::small ? 6.0 : object == Object::disc ? 75 : 30;
      expect_accurate(measure(bench.scene(object, half_size_px, range_m, move), move, noisy, noisy,
                              test::trials(3, 1)));
    }
  }
}

TEST_F(RegistrationTest, SlantedPlanes) {
  std::size_t turn = 0;
  for (const Object object : all_objects) {
    for (const geometry::HeadAngles move : moves) {
      if (test::few_trials && turn++ % 4 != 0) continue;
      SCOPED_TRACE(testing::Message() << name(object) << ", yaw " << move.yaw_rad);
      Scene scene = bench.scene(object, object == Object::small ? 6.0 : 50.0, 0.3, move);
      scene.tilt_rad = {0.3, -0.45};  // together 30 degrees
      expect_accurate(measure(scene, move, noisy, noisy, test::trials(2, 1)));
    }
  }
}

// An interpolant that locks to the pixel grid shows as an error that goes up and down with the
// sub-pixel place.
TEST_F(RegistrationTest, NoPixelLocking) {
  const geometry::HeadAngles move = moves[0];
  for (const Object object : {Object::square, Object::small}) {
    for (int step = 0; step < 8; step += test::trials(1, 2)) {
      Scene scene = bench.scene(object, object == Object::small ? 6.0 : 20.0, 0.5, move);
      scene.object_px += geometry::Pixel(step / 8.0, 0.3 + step / 8.0);
      const Errors errors = measure(scene, move, clean, clean, 1);
      EXPECT_EQ(errors.refused, 0) << errors.reason;
      EXPECT_LT(errors.worst_px, bias_max_px) << name(object) << " moved by " << step << "/8 px";
    }
  }
}

// Error over reported sigma, over edges, corners, outlines and texture of low contrast, where noise
// rules; 0.2 of that is what so few draws leave. Where it does not, the sigma may be larger by what
// sampling is reckoned with.
TEST_F(RegistrationTest, CovarianceIsHonestAtEveryNoise) {
  constexpr double factor = 1.5, sampling_sigma_px = 0.01;
  const geometry::HeadAngles move = moves[0];
  for (const auto& [object, half_size_px] : {std::pair{Object::disc, 12.0},
                                             {Object::square, 25.0},
                                             {Object::two_colours, 20.0},
                                             {Object::textured, 12.0},
                                             {Object::small, 7.0}}) {
    for (const double noise_levels : {1.0, 2.0, 4.0, 6.0}) {
      if (test::few_trials && (object != Object::disc || noise_levels != 4.0)) continue;
      SCOPED_TRACE(testing::Message() << name(object) << ", noise " << noise_levels);
      // A new place of the pixel grid now and then.
      Scene scene = bench.scene(object, half_size_px, 0.5, move);
      const auto paint = scene.paint;
      const Colour wall(150, 150, 150);
      // Low contrast, but so much that the noise leaves the object visible.
      const double contrast = std::max(0.2, 0.075 * noise_levels);
      scene.wall_colour = wall;
      scene.paint = [=](double u, double v) {
        return Colour(wall + contrast * (paint(u, v) - wall));
      };
      const Errors errors =
          measure(scene, move, {.noise_levels = noise_levels}, {.noise_levels = noise_levels}, 40);
      EXPECT_LE(errors.refused, 4) << errors.reason;
      const double least =
          errors.rms.minCoeff() / std::hypot(errors.rms.minCoeff(), sampling_sigma_px);
      EXPECT_THAT(errors.normalised.x(),
                  testing::AllOf(testing::Gt(least / factor), testing::Lt(factor)));
      EXPECT_THAT(errors.normalised.y(),
                  testing::AllOf(testing::Gt(least / factor), testing::Lt(factor)));
    }
  }
}

TEST_F(RegistrationTest, StrongNoise) {
  const geometry::HeadAngles move = moves[1];
  const Capture strong{.noise_levels = 5.0};
  for (const Object object : all_objects) {
    if (test::few_trials && object != Object::two_colours && object != Object::small) continue;
    SCOPED_TRACE(name(object));
    const Scene scene = bench.scene(object, object == Object::small ? 8.0 : 40.0, 0.4, move);
    const Errors errors = measure(scene, move, strong, strong, 5);
    EXPECT_EQ(errors.refused, 0) << errors.reason;
    EXPECT_LT(errors.mean.norm(), error_max_px);
    EXPECT_LT(errors.spread.maxCoeff(), error_max_px);
  }
}

TEST_F(RegistrationTest, ExposureMayChange) {
  const geometry::HeadAngles move = moves[0];
  for (const double gain : {0.8, 1.2}) {
    SCOPED_TRACE(gain);
    const Capture other{.noise_levels = 2.0, .gain = gain, .bias_levels = 8.0};
    expect_accurate(measure(bench.scene(Object::textured, 30.0, 0.4, move), move, noisy, other,
                            test::trials(4, 1)));
    expect_accurate(measure(bench.scene(Object::disc, 40.0, 0.4, move), move, noisy, other,
                            test::trials(4, 1)));
  }
}

TEST_F(RegistrationTest, LensDistortion) {
  for (const geometry::HeadAngles move : moves) {
    SCOPED_TRACE(move.yaw_rad);
    Scene scene = bench.scene(Object::square, 45.0, 0.4, move);
    // Five times the V5's published coefficients (naoqi_driver, camera_info_definitions.hpp): 15 px
    // at the object's place.
    scene.camera.distortion = {-0.27, 0.09, -0.0024, -0.0011, 0.0};
    expect_accurate(measure(scene, move, noisy, noisy, test::trials(4, 1)));
  }
}

TEST_F(RegistrationTest, FindsTheObjectInSpiteOfJointErrorsNobodyToldItOf) {
  const geometry::HeadAngles move = moves[0];
  std::size_t turn = 0;
  for (const geometry::HeadAngles error :
       {geometry::HeadAngles{0.02, 0.02}, geometry::HeadAngles{-0.03, 0.03},
        geometry::HeadAngles{0.0, -0.04}, geometry::HeadAngles{0.04, 0.0}}) {
    for (const Object object : {Object::disc, Object::textured, Object::small}) {
      if (test::few_trials && turn++ % 4 != 0) continue;  // each object, three of the errors
      SCOPED_TRACE(testing::Message()
                   << name(object) << " " << error.yaw_rad << " " << error.pitch_rad);
      const Scene scene = bench.scene(object, object == Object::small ? 6.0 : 35.0, 0.4, move);
      const Errors errors = measure(scene, move, noisy, noisy, 2, error);
      EXPECT_EQ(errors.refused, 0) << errors.reason;
      // The turn about the ray that such errors cause is not modelled: 4 mrad over 10 px.
      EXPECT_LT(errors.worst_px, error_max_px + 0.04);
    }
  }
}

/// A camera that is turned in its head turns the target about the line of sight as the head turns.
TEST_F(RegistrationTest, ATurnedMountIsMadeGoodOnceItIsBelieved) {
  const geometry::HeadAngles move = moves[2];
  const Scene scene = bench.scene(Object::square, 40.0, 0.5, move);
  geometry::Rig turned = bench.rig;
  turned.head.mount_rotation_rad += Eigen::Vector3d(0.0, 0.07, 0.07);
  Registration right = bench.registration(), wrong(turned, {}), told(turned, {});
  const Shot shot_1 = expose(look(scene, scene.head_1), noisy, bench.random);
  Shot shot_2 = expose(look(scene, move), noisy, bench.random);
  shot_2.head = move;
  const geometry::Pixel winner = scene.object_px + winner_error;
  ASSERT_TRUE(right.choose_target(shot_1.view(), winner).has_value());
  ASSERT_TRUE(wrong.choose_target(shot_1.view(), winner).has_value());
  ASSERT_TRUE(told.choose_target(shot_1.view(), winner).has_value());
  told.believe(bench.rig.head);
  const auto expected = right.find(shot_2.view()).match, before = wrong.find(shot_2.view()).match,
             after = told.find(shot_2.view()).match;
  ASSERT_TRUE(expected.has_value() && after.has_value());
  EXPECT_EQ(after->pixel_2, expected->pixel_2);
  EXPECT_TRUE(!before || before->pixel_2 != expected->pixel_2);
}

TEST_F(RegistrationTest, YuyvAndGrey) {
  constexpr int draws = 3;  // the mean of fewer is their noise
  const geometry::HeadAngles move = moves[1];
  std::size_t turn = 0;
  for (const base::PixelFormat format : {base::PixelFormat::yuyv, base::PixelFormat::grey}) {
    const Capture capture{.noise_levels = 2.0, .format = format};
    for (const Object object : all_objects) {
      if (test::few_trials && turn++ % 2 != 0) continue;  // each object, in one of the formats
      SCOPED_TRACE(testing::Message() << name(object) << ", format " << static_cast<int>(format));
      expect_accurate(measure(bench.scene(object, object == Object::small ? 8.0 : 40.0, 0.4, move),
                              move, capture, capture, draws));
    }
  }
}

TEST_F(RegistrationTest, RedOnAWallOfEqualLuma) {
  const geometry::HeadAngles move = moves[0];
  Scene scene = bench.scene(Object::disc, 30.0, 0.4, move);
  scene.paint = [](double, double) { return Colour(200, 60, 44); };  // BT.601 luma 100
  scene.wall_colour = {52, 134, 52};                                 // 100 too
  expect_accurate(measure(scene, move, noisy, noisy, test::trials(4, 1)));
}

// The background moves otherwise than the object: it must have no say.
TEST_F(RegistrationTest, InFrontOfATexturedWallFurtherAway) {
  const geometry::HeadAngles move = moves[0];
  Scene scene = bench.scene(Object::disc, 40.0, 0.3, move);
  scene.wall_behind_m = 0.5;
  scene.wall = [](double u, double v) {
    return Colour(Colour::Constant(120 + 100 * value_noise(u, v, 0.03, 3)));
  };
  const Errors errors = measure(scene, move, noisy, noisy, test::trials(4, 1));
  EXPECT_EQ(errors.refused, 0) << errors.reason;
  EXPECT_LT(errors.worst_px, 2.0 * error_max_px);  // the wall's grey changes along the outline
}

// Parallax slides what is seen behind the rim of an object along it. Taken for a part of the object
// it pulled squares by 0.40 px and small discs by 0.49 px.
TEST_F(RegistrationTest, BoardsBehindTheOutlineDoNotPull) {
  constexpr double gap_m = 0.4, pull_max_px = 0.12;
  std::size_t turn = 0;
  for (const auto& [object, half_size_px] :
       {std::pair{Object::square, 40.0}, {Object::small, 12.0}, {Object::disc, 50.0}}) {
    for (const geometry::HeadAngles move : moves) {
      if (test::few_trials && turn++ % 4 != 0) continue;
      SCOPED_TRACE(testing::Message() << name(object) << ", yaw " << move.yaw_rad);
      const double range_m = 0.3;
      Scene scene = bench.scene(object, half_size_px, range_m, move);
      scene.paint = [](double, double) { return Colour(235, 20, 40); };
      scene.wall_behind_m = gap_m;
      scene.wall = boards(range_m + gap_m, 5 + turn);
      const Errors errors = measure(scene, move, noisy, noisy, test::trials(2, 1));
      EXPECT_EQ(errors.refused, 0) << errors.reason;
      EXPECT_LT(errors.worst_px, pull_max_px);
    }
  }
}

// Where the background changes much, most of the object's outline fits worse than its flat
// interior, which fits best with no contrast at all.
TEST_F(RegistrationTest, AFlatInteriorDoesNotDecideTheGain) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::trials(2, 1)); ++seed) {
    SCOPED_TRACE(seed);
    const geometry::HeadAngles move = moves[seed % 3];
    Scene scene = bench.scene(Object::disc, 50.0, 0.3, move);
    scene.wall_behind_m = 0.5;
    scene.wall = [seed](double u, double v) {
      return Colour(Colour::Constant(120 + 100 * (value_noise(u, v, 0.015, seed) - 0.5) +
                                     60 * (value_noise(u, v, 0.0036, seed + 100) - 0.5)));
    };
    for (const double gain : {0.7, 1.3}) {
      if (test::few_trials && gain > 1.0) continue;
      const Capture other{.noise_levels = 2.0, .gain = gain};
      const Errors errors = measure(scene, move, noisy, other, 1);
      EXPECT_EQ(errors.refused, 0) << errors.reason;
      EXPECT_LT(errors.worst_px, 0.2);
    }
  }
}

TEST_F(RegistrationTest, CutByTheFrameInView1) {
  const geometry::HeadAngles move{0.2, -0.1};
  Scene scene = bench.scene(Object::textured, 50.0, 0.4, move);
  scene.object_px = {12.0, 300.0};
  scene.round = false;
  const Errors errors = measure(scene, move, noisy, noisy, 3);
  EXPECT_EQ(errors.refused, 0) << errors.reason;
  EXPECT_LT(errors.worst_px, error_max_px);
}

// A pole stands before the object in view 2.
TEST_F(RegistrationTest, PartlyCovered) {
  const geometry::HeadAngles move = moves[0];
  const Scene scene = bench.scene(Object::textured, 40.0, 0.4, move);
  const Shot shot_1 = expose(look(scene, {}), noisy, bench.random);
  Shot shot_2 = expose(look(scene, move), noisy, bench.random);
  Registration registration = bench.registration();
  const auto pixel_1 = registration.choose_target(shot_1.view(), scene.object_px + winner_error);
  ASSERT_TRUE(pixel_1);
  const geometry::Pixel truth = true_pixel_2(scene, move, *pixel_1);
  for (int y = 0; y < scene.camera.height_px; ++y) {
    for (int x = 0; x < 10; ++x) {
      std::fill_n(shot_2.image.row(y) + 3 * (static_cast<int>(truth.x()) + 12 + x), 3,
                  std::uint8_t{100});
    }
  }
  const RegistrationResult result = registration.find(shot_2.view());
  ASSERT_TRUE(result.match) << result.reason;
  EXPECT_LT((result.match->pixel_2 - truth).norm(), error_max_px);
}

}  // namespace
}  // namespace gazed::tracking::registration_test
