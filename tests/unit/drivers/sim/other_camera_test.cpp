#include "drivers/sim/other_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/geometry/robot.hpp"

namespace gazed::sim::other_camera_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(OtherCamera, WhatTheSigmasCoverIsTheSameOne) {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  const geometry::CameraModel simulated = rig.camera;
  EXPECT_EQ(other_camera(simulated, rig), "");
  rig.camera.focal_px.array() += 4.0 * rig.uncertainty.focal_sigma_px;
  rig.camera.centre_px.array() -= 4.0 * rig.uncertainty.centre_sigma_px;
  EXPECT_EQ(other_camera(simulated, rig), "");
}

TEST(OtherCamera, AnotherOnesCalibrationIsCalledSo) {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  const geometry::CameraModel simulated = rig.camera;
  rig.camera.focal_px = {300.0, 301.5};
  rig.uncertainty.focal_sigma_px = 0.5;
  EXPECT_THAT(other_camera(simulated, rig),
              AllOf(HasSubstr("(300.0, 301.5)"), HasSubstr("another robot's calibration")));
  rig.camera = simulated;
  rig.camera.centre_px.x() += 60.0;
  rig.uncertainty.centre_sigma_px = 1.0;
  EXPECT_THAT(other_camera(simulated, rig), HasSubstr("another robot's calibration"));
}

}  // namespace
}  // namespace gazed::sim::other_camera_test
