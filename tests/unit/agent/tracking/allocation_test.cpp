// Choosing, finding and following allocate nothing.

#include <gmock/gmock.h>

#include "agent/tracking/background.hpp"

#include "rig.hpp"
#include "room.hpp"
#include "tests/unit/allocations.hpp"

namespace gazed::tracking::allocation_test {
namespace {

TEST(Registration, AllocatesNothingPerTarget) {
  Rig rig;
  Registration registration = rig.registration();
  for (const Object object : all_objects) {
    const geometry::HeadAngles move = moves[0];
    const Scene scene = rig.scene(object, object == Object::small ? 6.0 : 60.0, 0.4, move);
    const Shot shot_1 = expose(look(scene, {}), {.noise_levels = 2.0}, rig.random);
    const Shot shot_2 = expose(look(scene, move), {.noise_levels = 2.0}, rig.random);
    const long before = test::allocations();
    const auto pixel_1 = registration.choose_target(shot_1.view(), scene.object_px);
    const bool found = registration.find(shot_2.view()).match.has_value();
    const long after = test::allocations();
    EXPECT_TRUE(pixel_1 && found) << name(object);
    EXPECT_EQ(after - before, 0) << name(object);
  }
}

TEST(Background, AllocatesNothing) {
  const RoomScene room(Paint::natural);
  const geometry::HeadAngles move{0.1, 0.1};
  const Photo photo_1 = room.photo({}, {}), photo_2 = room.photo(move, move);
  Background background(room.robot.camera, room.robot.head, room.robot.uncertainty);
  const long before = test::allocations();
  const std::size_t chosen = background.choose(photo_1.view(), {320, 240}, 60.0);
  const std::size_t found = background.follow(photo_2.view(), 1);
  const long after = test::allocations();
  EXPECT_GT(chosen, 50U);
  EXPECT_GT(found, 25U);
  EXPECT_EQ(after - before, 0);
}

}  // namespace
}  // namespace gazed::tracking::allocation_test
