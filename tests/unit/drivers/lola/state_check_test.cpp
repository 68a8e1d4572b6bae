#include "drivers/lola/state_check.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>

namespace gazed::lola::state_check_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

LolaState standing() {
  LolaState state;
  state.temperature_c.fill(38.0F);
  state.stiffness.fill(0.8F);
  return state;
}

TEST(StateCheck, AStandingRobotIsPlausible) {
  EXPECT_THAT(implausible(standing()), IsEmpty());
}

TEST(StateCheck, AHeadBeyondItsJointsIsNot) {
  for (const auto& [joint, angle_rad] : {std::pair{head_pitch, 2.0F},
                                         {head_pitch, 0.65F},
                                         {head_pitch, -3.0F},
                                         {head_pitch, -0.8F},
                                         {head_yaw, 2.3F},
                                         {head_yaw, -2.3F}}) {
    LolaState state = standing();
    state.position_rad[joint] = angle_rad;
    EXPECT_THAT(implausible(state), HasSubstr("beyond its joints' limits")) << angle_rad;
  }
}

TEST(StateCheck, AHeadALittleBeyondItsJointsIsPlausible) {
  LolaState state = standing();
  state.position_rad[head_pitch] = 0.56F;
  state.position_rad[head_yaw] = -2.15F;
  EXPECT_THAT(implausible(state), IsEmpty());
}

TEST(StateCheck, TemperaturesThatNoMotorHasAreNot) {
  for (const float temperature_c : {0.0F, -10.0F, 200.0F, NAN}) {
    LolaState state = standing();
    state.temperature_c[head_pitch] = temperature_c;
    EXPECT_THAT(implausible(state), HasSubstr("HeadPitch is said to have")) << temperature_c;
  }
}

TEST(StateCheck, AnotherJointsBrokenThermometerIsNoMatter) {
  LolaState state = standing();
  state.temperature_c[joint_count - 1] = 0.0F;
  EXPECT_THAT(implausible(state), IsEmpty());
}

TEST(StateCheck, AllZeroIsNoRobot) {
  EXPECT_THAT(implausible(LolaState{}), HasSubstr("HeadYaw is said to have 0 C"));
}

TEST(StateCheck, SwayIsNoChange) {
  LolaState state = standing();
  state.position_rad[9] += 0.04F;
  EXPECT_THAT(changed_since(standing(), state), IsEmpty());
  state.position_rad[9] += 0.02F;
  EXPECT_THAT(changed_since(standing(), state), HasSubstr("LHipPitch moves"));
}

}  // namespace
}  // namespace gazed::lola::state_check_test
