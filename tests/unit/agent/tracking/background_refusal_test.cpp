// What must give no corners, and what must do no harm.

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

#include "agent/geometry/robot.hpp"
#include "agent/tracking/background.hpp"

#include "room.hpp"

namespace gazed::tracking::background_refusal_test {
namespace {

struct BackgroundRefusal : testing::Test {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  std::mt19937 random{7};

  [[nodiscard]] Background background() const { return Background(rig); }
  base::Image garbage(base::PixelFormat format) {
    base::Image image(rig.camera.width_px, rig.camera.height_px, format);
    for (std::uint8_t& byte : image.pixels()) byte = static_cast<std::uint8_t>(random() >> 24);
    return image;
  }
};

TEST_F(BackgroundRefusal, ABlankWallWithCameraNoise) {
  const RoomScene room = RoomScene::blank_wall();
  const Photo photo = room.photo({}, {}, {.noise_levels = 2.0});
  Background one = background();
  EXPECT_EQ(one.choose(photo.view(), room.object_px({}), 80.0), 0U);
  EXPECT_EQ(one.follow(photo.view(), 1), 0U);
  EXPECT_TRUE(one.features().empty());
}

// In the dark the noise may look like corners, but never twice.
TEST_F(BackgroundRefusal, ABlankWallWithStrongNoise) {
  const RoomScene room = RoomScene::blank_wall();
  const geometry::HeadAngles move{0.1, 0.1};
  Background one = background();
  one.choose(room.photo({}, {}, {.noise_levels = 8.0, .seed = 1}).view(), room.object_px({}),
             110.0);
  EXPECT_EQ(one.follow(room.photo(move, move, {.noise_levels = 8.0, .seed = 2}).view(), 1), 0U);
}

TEST_F(BackgroundRefusal, ViewsThatDoNotOverlap) {
  const RoomScene room(Paint::natural, 10);
  const geometry::HeadAngles look_1{-0.8, 0.0}, look_2{0.8, 0.0};
  const Photo photo_1 = room.photo(look_1, look_1), photo_2 = room.photo(look_2, look_2);
  Background one = background();
  EXPECT_GT(one.choose(photo_1.view(), {320, 240}, 60.0), 50U);
  EXPECT_EQ(one.follow(photo_2.view(), 1), 0U);
}

// The angles say that the views overlap, the pictures are of different rooms.
TEST_F(BackgroundRefusal, AnotherRoom) {
  const geometry::HeadAngles move{0.1, 0.1};
  const Photo photo_1 = RoomScene(Paint::natural, 10).photo({}, {});
  const Photo photo_2 = RoomScene(Paint::natural, 50).photo(move, move);
  Background one = background();
  EXPECT_GT(one.choose(photo_1.view(), {320, 240}, 60.0), 50U);
  EXPECT_LE(one.follow(photo_2.view(), 1), 3U);
}

TEST_F(BackgroundRefusal, Garbage) {
  for (const base::PixelFormat format :
       {base::PixelFormat::grey, base::PixelFormat::rgb24, base::PixelFormat::yuyv}) {
    Background one = background();
    const base::Image first = garbage(format);
    one.choose({first.view(), {}, 0}, {320, 240}, 60.0);
    for (std::size_t look = 1; look < 4; ++look) {
      const base::Image later = garbage(format);
      const geometry::HeadAngles turned{0.1 * static_cast<double>(look), -0.1};
      EXPECT_LE(one.follow({later.view(), turned, 0}, look), 3U);
    }
  }
}

TEST_F(BackgroundRefusal, AnglesThatAreNoNumbersOrFarOff) {
  const double inf = std::numeric_limits<double>::infinity();
  const base::Image image = garbage(base::PixelFormat::rgb24);
  Background one = background();
  one.choose({image.view(), {}, 0}, {320, 240}, 60.0);
  std::size_t look = 1;
  for (const geometry::HeadAngles angles :
       {geometry::HeadAngles{std::nan(""), 0.0}, geometry::HeadAngles{0.0, inf},
        geometry::HeadAngles{3.1, 0.0}, geometry::HeadAngles{0.0, -1.6}}) {
    EXPECT_EQ(one.follow({image.view(), angles, 0}, look++), 0U);
  }
  one.choose({image.view(), {std::nan(""), 0.0}, 0}, {320, 240}, 60.0);
  EXPECT_EQ(one.follow({image.view(), {}, 0}, 1), 0U);
}

TEST_F(BackgroundRefusal, WithoutATargetEverythingIsBackground) {
  const base::Image image = garbage(base::PixelFormat::rgb24);
  Background one = background();
  EXPECT_EQ(one.choose({image.view(), {}, 0}, geometry::Pixel::Constant(std::nan("")), 60.0),
            triangulation::features_max);
}

TEST_F(BackgroundRefusal, ImagesOfAnotherSize) {
  base::Image small(320, 240, base::PixelFormat::rgb24);
  const base::Image image = garbage(base::PixelFormat::rgb24);
  Background one = background();
  EXPECT_GT(one.choose({image.view(), {}, 0}, {320, 240}, 60.0), 0U);
  EXPECT_EQ(one.follow({small.view(), {}, 0}, 1), 0U);
  EXPECT_EQ(one.follow({base::ImageView{}, {}, 0}, 2), 0U);
  EXPECT_EQ(one.choose({small.view(), {}, 0}, {320, 240}, 60.0), 0U);
  EXPECT_TRUE(one.features().empty());
}

TEST_F(BackgroundRefusal, LooksThatDoNotExist) {
  Background one = background();
  const base::Image image = garbage(base::PixelFormat::grey);
  EXPECT_THROW(one.follow({image.view(), {}, 0}, 0), std::invalid_argument);
  EXPECT_THROW(one.follow({image.view(), {}, 0}, triangulation::looks_max), std::invalid_argument);
}

TEST_F(BackgroundRefusal, CamerasThatCannotBe) {
  geometry::Rig blind = rig, tiny = rig;
  blind.focal_px.x() = 0.0;
  tiny.height_px = 63;
  EXPECT_THROW(Background{blind}, std::invalid_argument);
  EXPECT_THROW(Background{tiny}, std::invalid_argument);
}

// Odd sizes, the smallest, and uncertainties without bounds.
TEST_F(BackgroundRefusal, OddSizes) {
  for (const auto& [width, height] : {std::pair{64, 64}, std::pair{97, 65}, std::pair{161, 121}}) {
    rig.camera.width_px = width;
    rig.camera.height_px = height;
    rig.camera.focal_px = {150, 150};
    rig.camera.centre_px = {width / 2.0, height / 2.0};
    rig.uncertainty.encoder_sigma_rad = std::numeric_limits<double>::infinity();
    Background one = background();
    const base::Image image = garbage(base::PixelFormat::grey);
    one.choose({image.view(), {}, 0}, {10, 10}, 5.0);
    one.follow({image.view(), {0.05, 0.05}, 0}, 1);
    one.follow({image.view(), {}, 0}, 2);
    for (const triangulation::FeatureObservations& track : one.features()) {
      if (track.pixel[2].allFinite()) {
        EXPECT_LT((track.pixel[2] - track.pixel[0]).norm(), 0.1);
      }
    }
  }
}

}  // namespace
}  // namespace gazed::tracking::background_refusal_test
