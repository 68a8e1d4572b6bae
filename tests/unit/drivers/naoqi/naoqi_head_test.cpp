#include "drivers/naoqi/naoqi_head.hpp"

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "tests/unit/drivers/naoqi/head_rig.hpp"

namespace gazed::naoqi::naoqi_head_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using NaoqiHeadTest = NaoqiHeadRig;

TEST_F(NaoqiHeadTest, StatesAreWhatTheSensorsSay) {
  start();
  const geometry::HeadState& state = states_.back();
  EXPECT_EQ(state.measured.yaw_rad, 0.125);
  EXPECT_EQ(state.measured.pitch_rad, -0.0625);
  EXPECT_EQ(state.stiffness, 0.7F);
  EXPECT_EQ(state.temperature_c, 42.0F);
  EXPECT_TRUE(std::isnan(state.velocity_rad_s.yaw_rad));
}

TEST_F(NaoqiHeadTest, TheTimeIsTheMiddleBetweenQuestionAndAnswer) {
  start();
  states_.clear();
  const int asked = robot_.calls_of("getAngles");
  const auto is_asked = [&] {
    robot_.serve();
    return robot_.calls_of("getAngles") > asked;
  };
  // The robot takes the question at once, and its answer is fetched 40 ms later.
  std::int64_t asked_us = 0;
  while (!is_asked()) {
    asked_us = now_us_ += turn_us;
    static_cast<void>(dut().next_state());
  }
  now_us_ = asked_us + 40'000;
  const auto state = dut().next_state();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->utime_us, asked_us + 20'000);
  EXPECT_THAT(dut().notes(), HasSubstr("right within 20.0 ms"));
}

TEST_F(NaoqiHeadTest, AnglesAreAskedForEveryTenMilliseconds) {
  start();
  states_.clear();
  turn_for(1.0);
  EXPECT_GE(states_.size(), 90U);
  EXPECT_LE(states_.size(), 101U);
  for (std::size_t i = 1; i < states_.size(); ++i)
    ASSERT_GT(states_[i].utime_us, states_[i - 1].utime_us);
}

TEST_F(NaoqiHeadTest, StatesWaitToBeHandedOnAndTheOldestAreDropped) {
  start();
  states_.clear();
  const auto serve_for = [this](int turns) {
    for (int i = 0; i < turns; ++i) {
      robot_.serve();
      now_us_ += turn_us;
      dut().serve();
    }
  };
  serve_for(200);
  turn();
  EXPECT_GE(states_.size(), 15U);
  EXPECT_EQ(dut().notes().find("dropped"), std::string::npos);
  states_.clear();
  serve_for(1'000);
  turn();
  EXPECT_EQ(states_.size(), 32U);
  EXPECT_LE(now_us_ - states_.back().utime_us, 20 * turn_us);
  EXPECT_THAT(dut().notes(), HasSubstr("states dropped"));
}

TEST_F(NaoqiHeadTest, NothingIsAllocatedOnceItRuns) {
  start();
  allocated_ = 0;
  states_.reserve(1'000);
  turn_for(2.0);
  EXPECT_EQ(allocated_, 0);
}

TEST_F(NaoqiHeadTest, TheHeadIsTakenOverAndGivenBackAsItWas) {
  motion_.stiffness = {0.2F, 0.9F};
  start();
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.7F, 0.9F}));
  EXPECT_THAT(motion_.switched, ElementsAre("Head BreathEnabled off"));  // the posture was off
  end();
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.2F, 0.9F}));
  EXPECT_THAT(motion_.switched, ElementsAre("Head BreathEnabled off", "Head BreathEnabled on"));
}

TEST_F(NaoqiHeadTest, AnEndWhileItIsTakenOverChangesNothing) {
  const auto asked_nothing_yet = [this] {
    robot_.serve();
    return robot_.calls_of("getBreathEnabled") == 0;
  };
  while (asked_nothing_yet()) {
    now_us_ += turn_us;
    static_cast<void>(dut().next_state());
  }
  end();
  EXPECT_TRUE(motion_.breathing);
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.0F, 0.0F}));
}

TEST_F(NaoqiHeadTest, WhatIsAsItShouldBeIsLeftAlone) {
  motion_.stiffness = {1.0F, 0.8F};
  motion_.breathing = false;
  start();
  end();
  EXPECT_EQ(robot_.calls_of("setStiffnesses"), 0);
  EXPECT_THAT(motion_.switched, IsEmpty());
}

TEST_F(NaoqiHeadTest, ARobotWithoutTheOptionalMethodsIsTakenOver) {
  std::erase_if(robot_.methods, [](const FakeNaoqi::Method& each) {
    return each.name == "getLimits" || each.name.ends_with("Enabled");
  });
  start();
  command(0.25, 0.125);
  EXPECT_TRUE(turn_until([this] { return motion_.commands.size() == 1; }));
}

TEST_F(NaoqiHeadTest, ACommandIsSentOnce) {
  start();
  command(0.25, 0.125, 0.25);
  turn_for(2.0);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.25F, 0.125F}, 0.25F}));
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadTest, ACommandWaitsForTheHeadToBeTakenOver) {
  command(0.25, 0.125);
  command(0.375, 0.125);  // the newest is what counts
  turn_for(1.0);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.375F, 0.125F}, 0.5F}));
}

TEST_F(NaoqiHeadTest, CommandsOutsideTheTableGoToItsEdge) {
  start();
  command(9.0, -9.0, 7.0);
  turn_for(0.1);
  ASSERT_EQ(motion_.commands.size(), 1U);
  const auto [target, speed] = motion_.commands.front();
  EXPECT_NEAR(target[0], 2.08567, 1e-6);
  EXPECT_TRUE(geometry::HeadLimits().contains(
      {static_cast<double>(target[0]), static_cast<double>(target[1])}));
  EXPECT_EQ(speed, 1.0F);
}

TEST_F(NaoqiHeadTest, WhatIsNoCommandIsRefused) {
  start();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const geometry::HeadCommand& none : {geometry::HeadCommand{now_us_, {nan, 0.0}, 0.3},
                                            {now_us_, {0.0, infinite}, 0.3},
                                            {now_us_, {0.0, 0.0}, nan},
                                            {now_us_, {0.0, 0.0}, 0.0},
                                            {now_us_, {0.0, 0.0}, -0.3}}) {
    dut().command(none);
    EXPECT_THAT(dut().health().words, HasSubstr("is not a valid command"));
  }
  turn_for(0.1);
  EXPECT_THAT(motion_.commands, IsEmpty());
}

TEST_F(NaoqiHeadTest, TheRobotsNarrowerLimitsWin) {
  motion_.limits = {{{-0.5F, 0.5F}, {-0.25F, 0.25F}}};
  start();
  command(0.4375, 0.125);
  turn_for(0.1);
  EXPECT_EQ(dut().health().words, "");
  command(1.0, -0.3);
  turn_for(0.1);
  EXPECT_THAT(dut().health().words, HasSubstr("(1.000, -0.300) rad became (0.500, -0.250)"));
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.4375F, 0.125F}, 0.5F},
                                            FakeMotion::Command{{0.5F, -0.25F}, 0.5F}));
}

TEST_F(NaoqiHeadTest, ACommandThatComesBeforeTheLimitsIsClampedAsWell) {
  motion_.limits = {{{-0.5F, 0.5F}, {-0.25F, 0.25F}}};
  command(1.0, -0.3);
  EXPECT_TRUE(turn_until([this] { return motion_.commands.size() == 1; }));
  EXPECT_EQ(motion_.commands[0].target, (PerJoint{0.5F, -0.25F}));
}

TEST_F(NaoqiHeadTest, LimitsThatWereKnownStayWhenTheyAreNotToldAgain) {
  motion_.limits = {{{-0.5F, 0.5F}, {-0.25F, 0.25F}}};
  start();
  method("getLimits").handler = [](QiReader) { return fake_error("not today"); };
  robot_.close_all();
  EXPECT_TRUE(turn_until_fault("ALMotion.getLimits: not today"));
  command(1.0, -0.3);
  EXPECT_TRUE(turn_until([this] { return motion_.commands.size() == 1; }));
  EXPECT_EQ(motion_.commands[0].target, (PerJoint{0.5F, -0.25F}));
}

TEST_F(NaoqiHeadTest, NarrowerLimitsDoNotLeadOutOfTheTable) {
  motion_.limits[0] = {-1.5F, 1.5F};  // where the table is narrower in pitch than at 2 rad
  start();
  command(2.0, 0.3125);
  turn_for(0.1);
  ASSERT_EQ(motion_.commands.size(), 1U);
  const PerJoint target = motion_.commands[0].target;
  EXPECT_EQ(target[0], 1.5F);
  EXPECT_TRUE(geometry::HeadLimits().contains(
      {static_cast<double>(target[0]), static_cast<double>(target[1])}));
}

TEST_F(NaoqiHeadTest, WhatWaitsWhenItIsHeldIsNotSent) {
  command(0.25, 0.125);
  dut().hold();
  turn_for(1.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadTest, HoldStopsAHeadThatWasMoved) {
  start();
  dut().hold();
  turn_for(0.1);
  EXPECT_THAT(motion_.commands, IsEmpty());
  motion_.stuck = true;  // still on its way
  command(0.5, 0.125, 0.75);
  turn_for(0.1);
  dut().hold();
  turn_for(0.1);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.5F, 0.125F}, 0.75F},
                                            FakeMotion::Command{{0.125F, -0.0625F}, 0.75F}));
}

TEST_F(NaoqiHeadTest, AHeadBeyondItsLimitsIsHeldAtTheirEdge) {
  start();
  motion_.stuck = true;
  const geometry::HeadLimits limits;
  command(0.5, 0.125);
  turn_for(0.1);
  for (const geometry::HeadAngles said :
       {geometry::HeadAngles{0.5, 0.55}, {-2.2, -0.7}, {1.5, 0.25}, {3.0, 3.0}}) {
    motion_.angles = {static_cast<float>(said.yaw_rad), static_cast<float>(said.pitch_rad)};
    ASSERT_FALSE(limits.contains(said));
    turn_for(0.05);
    dut().hold();
    turn_for(0.05);
    const PerJoint held = motion_.commands.back().target;
    const geometry::HeadAngles target{static_cast<double>(held[0]), static_cast<double>(held[1])};
    EXPECT_TRUE(limits.contains(target)) << target.yaw_rad << ' ' << target.pitch_rad;
    EXPECT_LT(geometry::greatest_difference(target, limits.clamp(said)), 1e-6);
  }
}

}  // namespace
}  // namespace gazed::naoqi::naoqi_head_test
