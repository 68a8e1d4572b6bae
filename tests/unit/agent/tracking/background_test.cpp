// Are the corners of look 1 found in a later look, at the right place, with an honest sigma?

#include "agent/tracking/background.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "room.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::tracking::background_test {
namespace {

constexpr double outlier_px = 3.0;
constexpr double target_radius_px = 60.0;
// A corner nearer than this to the later frame's border cannot be expected.
constexpr double border_px = 12.0;

struct Errors {
  double visible = 0, found = 0, outliers = 0;
  std::vector<double> normalised;  // error / sigma, both axes, without the outliers

  [[nodiscard]] double share() const { return found / visible; }
  [[nodiscard]] double spread() const {
    double squares = 0.0;
    for (const double z : normalised) squares += z * z;
    return std::sqrt(squares / static_cast<double>(normalised.size()));
  }
};

class BackgroundTest : public testing::Test {
 protected:
  // A patch that holds two depths, at the border of a nearer thing, may follow either.
  static std::optional<geometry::Pixel> nearest_truth(const RoomScene& room,
                                                      geometry::HeadAngles look_1,
                                                      geometry::HeadAngles look_2,
                                                      const geometry::Pixel& pixel_1,
                                                      const geometry::Pixel& pixel_2) {
    auto best = room.true_pixel(look_1, look_2, pixel_1, 0.0);
    for (const double radius : {5.0, 9.0}) {
      for (int k = 0; k < 8; ++k) {
        const double angle = k * std::numbers::pi / 4;
        const geometry::Pixel beside =
            pixel_1 + radius * geometry::Pixel(std::cos(angle), std::sin(angle));
        const auto other = room.seen_at_depth_of(look_1, look_2, pixel_1, beside);
        if (other && (!best || (*other - pixel_2).norm() < (*best - pixel_2).norm() - 0.5)) {
          best = other;
        }
      }
    }
    return best;
  }

  static void compare(const Background& background, std::size_t look, const RoomScene& room,
                      geometry::HeadAngles look_1, geometry::HeadAngles look_2, Errors& errors) {
    for (const triangulation::FeatureObservations& track : background.features()) {
      const geometry::Pixel &pixel_1 = track.pixel[0], &pixel_2 = track.pixel[look];
      if (room.true_pixel(look_1, look_2, pixel_1, border_px)) ++errors.visible;
      if (!pixel_2.allFinite()) continue;
      ++errors.found;
      const auto truth = nearest_truth(room, look_1, look_2, pixel_1, pixel_2);
      if (!truth || (*truth - pixel_2).norm() > outlier_px) {
        ++errors.outliers;
        continue;
      }
      for (int k = 0; k < 2; ++k) {
        errors.normalised.push_back((pixel_2[k] - (*truth)[k]) / track.sigma_px);
      }
    }
  }

  // One look at a room and a second after `move`, with exposures 1 and 2.
  static Errors follow(const RoomScene& room, geometry::HeadAngles move, const Exposure& exposure_1,
                       const Exposure& exposure_2) {
    const geometry::HeadAngles look_1{-move.yaw_rad / 2, -move.pitch_rad / 2};
    const geometry::HeadAngles look_2 = look_1 + move;
    const Photo photo_1 = room.photo(look_1, look_1, exposure_1);
    const Photo photo_2 = room.photo(look_2, look_2, exposure_2);
    Background background(room.rig);
    background.choose(photo_1.view(), room.object_px(look_1), target_radius_px);
    const std::size_t found = background.follow(photo_2.view(), 1);
    Errors errors;
    compare(background, 1, room, look_1, look_2, errors);
    EXPECT_EQ(static_cast<double>(found), errors.found);
    return errors;
  }

  static constexpr geometry::HeadAngles small_move{0.15, 0.12};
};

constexpr std::array moves = {geometry::HeadAngles{0.1, 0.1},    geometry::HeadAngles{-0.3, 0.2},
                              geometry::HeadAngles{0.45, -0.15}, geometry::HeadAngles{-0.4, -0.3},
                              geometry::HeadAngles{0.7, 0.2},    geometry::HeadAngles{0.12, -0.1}};

// The encoders' errors, and what the agent is told of them. Gaussian, of either sign.
constexpr std::array<geometry::HeadAngles, 4> unit_errors = {
    geometry::HeadAngles{0.8, -1.1}, geometry::HeadAngles{-1.2, 0.6},
    geometry::HeadAngles{0.3, 0.9}, geometry::HeadAngles{-0.7, -0.5}};

TEST_F(BackgroundTest, TexturedRoomWithAngleErrors) {
  std::array<Errors, 3> of_sigma;
  constexpr std::array sigmas = {0.0, 0.0015, 0.02};
  const auto count = static_cast<std::size_t>(test::trials(static_cast<int>(moves.size()), 1));
  for (std::size_t trial = 0; trial < count; ++trial) {
    RoomScene room(Paint::natural, static_cast<std::uint32_t>(10 * trial + 10));
    const geometry::HeadAngles move = moves[trial];
    const geometry::HeadAngles look_1{-move.yaw_rad / 2, -move.pitch_rad / 2},
        look_2 = look_1 + move;
    Photo photo_1 = room.photo(look_1, look_1, {.seed = 1});
    Photo photo_2 = room.photo(look_2, look_2, {.seed = 2});
    for (std::size_t k = 0; k < sigmas.size(); ++k) {
      const auto said = [&](geometry::HeadAngles true_angles, std::size_t i) {
        const geometry::HeadAngles unit = unit_errors[i % unit_errors.size()];
        return true_angles +
               geometry::HeadAngles{sigmas[k] * unit.yaw_rad, sigmas[k] * unit.pitch_rad};
      };
      photo_1.measured = said(look_1, trial);
      photo_2.measured = said(look_2, trial + 1);
      room.rig.uncertainty = {};
      room.rig.uncertainty.encoder_sigma_rad = sigmas[k];
      Background background(room.rig);
      EXPECT_EQ(background.choose(photo_1.view(), room.object_px(look_1), target_radius_px),
                triangulation::features_max);
      background.follow(photo_2.view(), 1);
      compare(background, 1, room, look_1, look_2, of_sigma[k]);
    }
  }
  for (std::size_t k = 0; k < sigmas.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "encoders " << sigmas[k] << " rad");
    const Errors& errors = of_sigma[k];
    EXPECT_GT(errors.share(), 0.7);  // the rest: depth edges, and what they hide
    EXPECT_LT(errors.outliers, 0.02 * errors.found);
    EXPECT_GT(errors.spread(), 0.75);
    EXPECT_LT(errors.spread(), 1.25);
    RecordProperty("share_" + std::to_string(k), std::to_string(errors.share()));
    RecordProperty("spread_" + std::to_string(k), std::to_string(errors.spread()));
  }
}

// Tiles are alike: what could be another tile is left out, what is kept is right.
TEST_F(BackgroundTest, CheckeredRoom) {
  Errors errors;
  for (std::size_t trial = 0; trial < test::trials(3, 1); ++trial) {
    const RoomScene room(Paint::checker, static_cast<std::uint32_t>(10 * trial + 10));
    const Errors one = follow(room, moves[trial], {.seed = 1}, {.seed = 2});
    errors.visible += one.visible;
    errors.found += one.found;
    errors.outliers += one.outliers;
  }
  EXPECT_GT(errors.share(), 0.35);
  EXPECT_LT(errors.outliers, 0.02 * errors.found);
}

TEST_F(BackgroundTest, ExposureChange) {
  const RoomScene room(Paint::natural, 10);
  for (const double exposure : {0.7, 1.3}) {
    if (test::few_trials && exposure < 1.0) continue;
    const Errors errors = follow(room, small_move, {.seed = 1}, {.exposure = exposure, .seed = 2});
    EXPECT_GT(errors.share(), 0.6);
    EXPECT_LT(errors.outliers, 0.02 * errors.found);
    EXPECT_LT(errors.spread(), 1.25);
  }
}

TEST_F(BackgroundTest, Distortion) {
  const RoomScene room(Paint::natural, 10, {-0.08, 0.02, 1e-3, -1e-3, 0.0});
  const Errors errors = follow(room, moves[1], {.seed = 1}, {.seed = 2});
  EXPECT_GT(errors.share(), 0.6);
  EXPECT_LT(errors.outliers, 0.02 * errors.found);
  EXPECT_LT(errors.spread(), 1.25);
}

TEST_F(BackgroundTest, AllPixelFormats) {
  const RoomScene room(Paint::natural, 10);
  for (const base::PixelFormat format :
       {base::PixelFormat::grey, base::PixelFormat::rgb24, base::PixelFormat::yuyv}) {
    if (test::few_trials && format != base::PixelFormat::yuyv) continue;
    const Errors errors =
        follow(room, small_move, {.format = format, .seed = 1}, {.format = format, .seed = 2});
    EXPECT_GT(errors.share(), 0.6);
    EXPECT_LT(errors.outliers, 0.02 * errors.found);
    EXPECT_LT(errors.spread(), 1.25);
  }
}

// None is chosen on the object, and where it went, what it hides and uncovers is no background.
TEST_F(BackgroundTest, TheTargetMoves) {
  RoomScene room(Paint::natural, 10);
  const geometry::HeadAngles look_1{}, look_2 = small_move;
  const geometry::Pixel target = room.object_px(look_1);
  const Photo photo_1 = room.photo(look_1, look_1, {.seed = 1});
  Background background(room.rig);
  background.choose(photo_1.view(), target, target_radius_px);
  for (const triangulation::FeatureObservations& track : background.features()) {
    EXPECT_GE((track.pixel[0] - target).norm(), target_radius_px);
  }
  room.move_object({0.0, 0.05, 0.02});
  background.follow(room.photo(look_2, look_2, {.seed = 2}).view(), 1);
  Errors errors;
  compare(background, 1, room, look_1, look_2, errors);
  EXPECT_GT(errors.share(), 0.6);
  EXPECT_LT(errors.outliers, 0.02 * errors.found);
}

// A box that moves between the looks takes its corners with it: they are left out.
TEST_F(BackgroundTest, AnotherThingMoves) {
  RoomScene room(Paint::natural, 10);
  const geometry::HeadAngles look_1{}, look_2 = small_move;
  const Photo photo_1 = room.photo(look_1, look_1, {.seed = 1});
  Background background(room.rig);
  background.choose(photo_1.view(), room.object_px(look_1), target_radius_px);
  RoomScene still = room;
  room.world.surfaces[4].centre_m += Eigen::Vector3d(0.0, 0.01, 0.012);  // the box at 0.8 m
  background.follow(room.photo(look_2, look_2, {.seed = 2}).view(), 1);
  Errors errors;  // against where things would be had nothing moved
  compare(background, 1, still, look_1, look_2, errors);
  EXPECT_GT(errors.found, 25);
  EXPECT_LE(errors.outliers, 1);
}

TEST_F(BackgroundTest, SeveralLooks) {
  const RoomScene room(Paint::natural, 20);
  const geometry::HeadAngles look_1{};
  Background background(room.rig);
  background.choose(room.photo(look_1, look_1, {.seed = 1}).view(), room.object_px(look_1),
                    target_radius_px);
  for (std::size_t look = 1; look <= test::trials(3, 2); ++look) {
    const geometry::HeadAngles angles{0.12 * static_cast<double>(look) - 0.3, 0.1};
    background.follow(room.photo(angles, angles, {.seed = 10 + look}).view(), look);
    Errors errors;
    compare(background, look, room, look_1, angles, errors);
    EXPECT_GT(errors.share(), 0.6);
    EXPECT_LT(errors.outliers, 0.02 * errors.found + 1.0);
  }
}

/// By a head that is believed otherwise meanwhile: nothing of what was found before is left.
TEST_F(BackgroundTest, ALookMayBeFollowedOnceMore) {
  const RoomScene room(Paint::natural, 15);
  const Photo photo_1 = room.photo({}, {}, {.seed = 1});
  const Photo photo_2 = room.photo(small_move, small_move, {.seed = 2});
  geometry::Rig turned = room.rig;
  turned.head.mount_rotation_rad += Eigen::Vector3d(0.1, 0.05, 0.0);
  Background once(room.rig), twice(turned);
  once.choose(photo_1.view(), {320, 240}, target_radius_px);
  twice.choose(photo_1.view(), {320, 240}, target_radius_px);
  once.follow(photo_2.view(), 1);
  twice.follow(photo_2.view(), 1);
  twice.believe(room.rig.head);
  twice.follow(photo_2.view(), 1);
  for (std::size_t i = 0; i < once.features().size(); ++i) {
    const triangulation::FeatureObservations &a = once.features()[i], &b = twice.features()[i];
    EXPECT_EQ(a.pixel[1].allFinite(), b.pixel[1].allFinite());
    if (!a.pixel[1].allFinite()) continue;
    EXPECT_EQ(a.pixel[1], b.pixel[1]);
    EXPECT_EQ(a.sigma_px, b.sigma_px);
  }
}

TEST_F(BackgroundTest, SameInputSameBits) {
  const RoomScene room(Paint::natural, 10);
  const Photo photo_1 = room.photo({}, {}, {.seed = 1});
  const Photo photo_2 = room.photo(small_move, small_move, {.seed = 2});
  Background first(room.rig);
  Background second(room.rig);
  // Used before: nothing of that may be left.
  second.choose(photo_2.view(), {100, 100}, 10.0);
  second.follow(photo_1.view(), 3);
  for (Background* one : {&first, &second}) {
    one->choose(photo_1.view(), {320, 240}, target_radius_px);
    one->follow(photo_2.view(), 1);
  }
  ASSERT_EQ(first.features().size(), second.features().size());
  for (std::size_t i = 0; i < first.features().size(); ++i) {
    const triangulation::FeatureObservations &a = first.features()[i], &b = second.features()[i];
    EXPECT_EQ(a.pixel[0], b.pixel[0]);
    EXPECT_EQ(a.pixel[1].allFinite(), b.pixel[1].allFinite());
    if (a.pixel[1].allFinite()) {
      EXPECT_EQ(a.pixel[1], b.pixel[1]);
    }
    EXPECT_EQ(a.sigma_px, b.sigma_px);
    EXPECT_FALSE(b.pixel[3].allFinite());
  }
}

}  // namespace
}  // namespace gazed::tracking::background_test
