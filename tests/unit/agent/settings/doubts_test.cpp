#include "agent/settings/doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string_view>

#include "agent/geometry/robot.hpp"

namespace gazed::settings::doubts_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Doubts, NoRobotsOwnNumbersAreDoubted) {
  for (const std::string_view robot : geometry::robot_names) {
    for (const auto position : {geometry::CameraPosition::top, geometry::CameraPosition::bottom})
      EXPECT_THAT(doubts(default_settings(robot, position)), IsEmpty()) << robot;
  }
}

TEST(Doubts, AMountThatLooksAtTheFloorAndASigmaOfAMetre) {
  Settings settings = default_settings();
  settings.rig.head.mount_rotation_rad.y() = 1.2;
  settings.rig.uncertainty.mount_offset_sigma_m = 1.0;
  EXPECT_THAT(
      doubts(settings),
      ElementsAre(
          "camera.mount_rotation_rad: [0.0, 1.2, 0.0] can hardly be meant; usual: -0.8 to 0.8",
          "uncertainty.mount_offset_sigma_m: 1.0 can hardly be meant; usual: 0 to 0.05"));
}

TEST(Doubts, AFocalLengthOfAnotherImageSize) {
  Settings settings = default_settings();
  settings.rig.camera.focal_px.setConstant(150.0);
  EXPECT_THAT(doubts(settings), ElementsAre(HasSubstr("camera.focal_px: [150.0, 150.0] can")));
}

}  // namespace
}  // namespace gazed::settings::doubts_test
