// Is pixel_2 right, and does its covariance say how right?

#include "agent/tracking/registration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <string>
#include <utility>

#include "rig.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::tracking::registration_test {
namespace {

// The goal for clean images with camera noise of 2 levels: at 1 m and 0.1 rad this is 2 % of the
// range, below what the joints cost.
constexpr double error_max_px = 0.05;
// Mean over noise: what is left is the model and the sampling of sharp edges.
constexpr double bias_max_px = 0.03;
// Over noise of 2 levels; the smallest object has 38 px of outline.
constexpr double spread_max_px = 0.02;

struct Errors {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d spread = Eigen::Vector2d::Zero();      // standard deviation about the mean
  Eigen::Vector2d normalised = Eigen::Vector2d::Zero();  // root mean square of error / sigma
  double worst_px = 0.0;
  int refused = 0;
  std::string reason;
};

class RegistrationTest : public testing::Test {
 protected:
  // The errors of pixel_2 over `draws` of the noise. The angles of look 2 are reported as
  // move + joint_error.
  Errors measure(const Scene& scene, geometry::HeadAngles move, const Capture& capture_1,
                 const Capture& capture_2, int draws, geometry::HeadAngles joint_error = {}) {
    Registration registration({}, scene.camera, scene.head, rig.robot.uncertainty);
    const Radiance look_1 = look(scene, scene.head_1), look_2 = look(scene, move);
    Errors errors;
    Eigen::Vector2d squares = Eigen::Vector2d::Zero();
    int found = 0;
    for (int draw = 0; draw < draws; ++draw) {
      const Shot shot_1 = expose(look_1, capture_1, rig.random);
      Shot shot_2 = expose(look_2, capture_2, rig.random);
      shot_2.head = move + joint_error;
      const auto pixel_1 =
          registration.choose_target(shot_1.view(), scene.object_px + winner_error);
      if (!pixel_1 || !on_object(scene, *pixel_1)) {
        ++errors.refused;
        errors.reason = pixel_1 ? "pixel_1 is not on the object" : "no target chosen";
        continue;
      }
      const RegistrationResult result = registration.find(shot_2.view());
      if (!result.match) {
        ++errors.refused;
        errors.reason = result.reason;
        continue;
      }
      ++found;
      const Eigen::Vector2d error = result.match->pixel_2 - true_pixel_2(scene, move, *pixel_1);
      errors.mean += error;
      squares += error.cwiseAbs2();
      errors.normalised += error.cwiseAbs2().cwiseQuotient(result.match->covariance_px2.diagonal());
      errors.worst_px = std::max(errors.worst_px, error.norm());
    }
    errors.mean /= found;
    errors.spread = (squares / found - errors.mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    errors.normalised = (errors.normalised / found).cwiseSqrt();
    return errors;
  }

  static void expect_accurate(const Errors& errors) {
    EXPECT_EQ(errors.refused, 0) << errors.reason;
    EXPECT_LT(errors.worst_px, error_max_px);
    EXPECT_LT(errors.mean.norm(), bias_max_px);
    EXPECT_LT(errors.spread.maxCoeff(), spread_max_px);
  }

  Rig rig;
  const Capture clean;
  const Capture noisy{.noise_levels = 2.0};
};

TEST_F(RegistrationTest, EveryObjectAtEveryRange) {
  std::size_t turn = 0;
  for (const Object object : all_objects) {
    for (const double range_m : {0.2, 0.6, 2.0}) {
      const geometry::HeadAngles move = moves[turn++ % moves.size()];
      if (test::few_trials && turn % 4 != 1) continue;  // each range and move, four of the objects
      SCOPED_TRACE(testing::Message() << name(object) << " at " << range_m << " m, move ("
                                      << move.yaw_rad << ", " << move.pitch_rad << ")");
      const double half_size_px = object == Object::small ? 6.0 : object == Object::disc ? 75 : 30;
      expect_accurate(measure(rig.scene(object, half_size_px, range_m, move), move, noisy, noisy,
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
      Scene scene = rig.scene(object, object == Object::small ? 6.0 : 50.0, 0.3, move);
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
      Scene scene = rig.scene(object, object == Object::small ? 6.0 : 20.0, 0.5, move);
      scene.object_px += geometry::Pixel(step / 8.0, 0.3 + step / 8.0);
      const Errors errors = measure(scene, move, clean, clean, 1);
      EXPECT_EQ(errors.refused, 0) << errors.reason;
      EXPECT_LT(errors.worst_px, bias_max_px) << name(object) << " moved by " << step << "/8 px";
    }
  }
}

// Where noise rules, error over reported sigma is 1 within the 0.3 that estimating the noise's
// correlation leaves.
TEST_F(RegistrationTest, CovarianceIsHonest) {
  const geometry::HeadAngles move = moves[0];
  for (const auto& [object, half_size_px] :
       {std::pair{Object::disc, 12.0}, {Object::square, 25.0}, {Object::textured, 12.0}}) {
    if (test::few_trials && object != Object::disc) continue;
    SCOPED_TRACE(name(object));
    Scene scene = rig.scene(object, half_size_px, 0.5, move);
    const auto paint = scene.paint;
    const Colour wall(150, 150, 150);
    scene.wall_colour = wall;
    scene.paint = [=](double u, double v) { return Colour(wall + 0.3 * (paint(u, v) - wall)); };
    const Errors errors = measure(scene, move, {.noise_levels = 4.0}, {.noise_levels = 4.0}, 80);
    EXPECT_LE(errors.refused, 3) << errors.reason;
    EXPECT_THAT(errors.normalised.x(), testing::AllOf(testing::Gt(0.7), testing::Lt(1.3)));
    EXPECT_THAT(errors.normalised.y(), testing::AllOf(testing::Gt(0.7), testing::Lt(1.3)));
  }
}

TEST_F(RegistrationTest, StrongNoise) {
  const geometry::HeadAngles move = moves[1];
  const Capture strong{.noise_levels = 5.0};
  for (const Object object : all_objects) {
    if (test::few_trials && object != Object::two_colours && object != Object::small) continue;
    SCOPED_TRACE(name(object));
    const Scene scene = rig.scene(object, object == Object::small ? 8.0 : 40.0, 0.4, move);
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
    expect_accurate(measure(rig.scene(Object::textured, 30.0, 0.4, move), move, noisy, other,
                            test::trials(4, 1)));
    expect_accurate(
        measure(rig.scene(Object::disc, 40.0, 0.4, move), move, noisy, other, test::trials(4, 1)));
  }
}

TEST_F(RegistrationTest, LensDistortion) {
  for (const geometry::HeadAngles move : moves) {
    SCOPED_TRACE(move.yaw_rad);
    Scene scene = rig.scene(Object::square, 45.0, 0.4, move);
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
      const Scene scene = rig.scene(object, object == Object::small ? 6.0 : 35.0, 0.4, move);
      const Errors errors = measure(scene, move, noisy, noisy, 2, error);
      EXPECT_EQ(errors.refused, 0) << errors.reason;
      // The turn about the ray that such errors cause is not modelled: 4 mrad over 10 px.
      EXPECT_LT(errors.worst_px, error_max_px + 0.04);
    }
  }
}

TEST_F(RegistrationTest, YuyvAndGrey) {
  const geometry::HeadAngles move = moves[1];
  std::size_t turn = 0;
  for (const base::PixelFormat format : {base::PixelFormat::yuyv, base::PixelFormat::grey}) {
    const Capture capture{.noise_levels = 2.0, .format = format};
    for (const Object object : all_objects) {
      if (test::few_trials && turn++ % 2 != 0) continue;  // each object, in one of the formats
      SCOPED_TRACE(testing::Message() << name(object) << ", format " << static_cast<int>(format));
      expect_accurate(measure(rig.scene(object, object == Object::small ? 8.0 : 40.0, 0.4, move),
                              move, capture, capture, test::trials(3, 1)));
    }
  }
}

TEST_F(RegistrationTest, RedOnAWallOfEqualLuma) {
  const geometry::HeadAngles move = moves[0];
  Scene scene = rig.scene(Object::disc, 30.0, 0.4, move);
  scene.paint = [](double, double) { return Colour(200, 60, 44); };  // BT.601 luma 100
  scene.wall_colour = {52, 134, 52};                                 // 100 too
  expect_accurate(measure(scene, move, noisy, noisy, test::trials(4, 1)));
}

// The background moves otherwise than the object: it must have no say.
TEST_F(RegistrationTest, InFrontOfATexturedWallFurtherAway) {
  const geometry::HeadAngles move = moves[0];
  Scene scene = rig.scene(Object::disc, 40.0, 0.3, move);
  scene.wall_behind_m = 0.5;
  scene.wall = [](double u, double v) {
    return Colour(Colour::Constant(120 + 100 * value_noise(u, v, 0.03, 3)));
  };
  const Errors errors = measure(scene, move, noisy, noisy, test::trials(4, 1));
  EXPECT_EQ(errors.refused, 0) << errors.reason;
  EXPECT_LT(errors.worst_px, 2.0 * error_max_px);  // the wall's grey changes along the outline
}

TEST_F(RegistrationTest, CutByTheFrameInView1) {
  const geometry::HeadAngles move{0.2, -0.1};
  Scene scene = rig.scene(Object::textured, 50.0, 0.4, move);
  scene.object_px = {12.0, 300.0};
  scene.round = false;
  const Errors errors = measure(scene, move, noisy, noisy, 3);
  EXPECT_EQ(errors.refused, 0) << errors.reason;
  EXPECT_LT(errors.worst_px, error_max_px);
}

// A pole stands before the object in view 2.
TEST_F(RegistrationTest, PartlyCovered) {
  const geometry::HeadAngles move = moves[0];
  const Scene scene = rig.scene(Object::textured, 40.0, 0.4, move);
  const Shot shot_1 = expose(look(scene, {}), noisy, rig.random);
  Shot shot_2 = expose(look(scene, move), noisy, rig.random);
  Registration registration = rig.registration();
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
