// Are the corners of look 1 found in a later look, at the right place, with an honest sigma?

#include "agent/target/background.hpp"

#include <gmock/gmock.h>

#include "room.hpp"

namespace gazed::test {
namespace {

TEST(Background, FollowsMostCornersOfATexturedRoom) {
  RoomScene room(Paint::natural);
  const HeadAngles look_1{-0.1, 0.0}, look_2{0.1, 0.15};
  const Photo photo_1 = room.photo(look_1, look_1, {.seed = 1});
  const Photo photo_2 = room.photo(look_2, look_2, {.seed = 2});
  Background background(room.robot.camera, room.robot.head, room.robot.uncertainty);
  EXPECT_EQ(background.choose(photo_1.view(), room.object_px(look_1), 60.0), features_max);
  const std::size_t found = background.follow(photo_2.view(), 1);
  EXPECT_GT(found, 30U);
  std::size_t right = 0;
  for (const FeatureTrack& track : background.tracks()) {
    if (!track.pixel[1].allFinite()) continue;
    const auto truth = room.true_pixel(look_1, look_2, track.pixel[0], 0.0);
    if (truth && (*truth - track.pixel[1]).norm() < 3.0) ++right;
  }
  EXPECT_GT(right, found * 9 / 10);
}

}  // namespace
}  // namespace gazed::test
