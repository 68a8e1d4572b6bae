// Robots that do not do as they are told, or not what they say.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/drivers/naoqi/head_rig.hpp"

namespace gazed::naoqi::head_faults_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using NaoqiHeadFaults = NaoqiHeadRig;

TEST_F(NaoqiHeadFaults, ALoopThatWasAwayIsNoFaultOfTheRobot) {
  start();
  states_.clear();
  const int asked = robot_.calls_of("getAngles");
  turn_until([&] { return robot_.calls_of("getAngles") > asked; });
  robot_.serve();
  now_us_ += 150'000;
  turn_until([&] { return robot_.calls_of("getAngles") > asked + 1; });
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, AnglesThatWaitedBehindAnotherAnswerAreNoFaultOfTheRobot) {
  start();
  bool wait = false;
  for (int i = 0; i < 2'000 && !wait; ++i) {
    for (int turns = 3 + i % 11; turns > 0; --turns) {
      now_us_ += turn_us;
      dut().serve();
    }
    robot_.called.clear();
    robot_.serve();
    wait = robot_.called == std::vector<std::string>{"getStiffnesses", "getAngles"};
  }
  ASSERT_TRUE(wait);
  now_us_ += 150'000;
  for (int turns = 0; turns < 10; ++turns) {
    turn();
    EXPECT_EQ(dut().health().words, "");
  }
}

TEST_F(NaoqiHeadFaults, AStiffnessThatCannotBeSetIsTriedAgain) {
  const auto works = method("setStiffnesses").handler;
  method("setStiffnesses").handler = [](QiReader) { return fake_error("no motors"); };
  EXPECT_TRUE(turn_until_fault("ALMotion.setStiffnesses: no motors"));
  command(0.25, 0.125);
  turn_for(1.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
  method("setStiffnesses").handler = works;
  EXPECT_TRUE(turn_until([this] { return motion_.stiffness[0] > 0.0F; }));
  command(0.25, 0.125);
  EXPECT_TRUE(turn_until([this] { return motion_.commands.size() == 1; }));
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, ACommandThatWaitsTooLongIsNeverSent) {
  start();
  robot_.answers = false;
  turn_for(0.5);
  command(0.25, 0.125);
  EXPECT_TRUE(turn_until_fault("no answer for 1.0 s"));
  turn_for(1.0);
  robot_.answers = true;
  turn_for(3.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
  EXPECT_THAT(dut().health().words, HasSubstr("a command was not sent"));
  command(0.25, 0.125);
  turn_for(0.1);
  EXPECT_EQ(motion_.commands.size(), 1U);
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, LimitsThatAreNoneAreNotUsed) {
  motion_.limits = {{{0.5F, -0.5F}, {std::nanf(""), 0.2F}}};
  command(0.4375, 0.125);
  turn_for(1.0);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.4375F, 0.125F}, 0.5F}));
  EXPECT_THAT(dut().health().words, HasSubstr("getLimits"));
}

TEST_F(NaoqiHeadFaults, AnglesThatAreNoneArePassedOverAndTold) {
  start();
  struct Case {
    FakeAnswer answer;
    const char* told;
  };
  for (const Case& c :
       {Case{fake_numbers({std::nanf(""), 0.0F}), "robot says the head is at (nan, 0) rad"},
        {fake_numbers({0.0F, 4.0F}), "robot says the head is at (0, 4) rad"},
        {fake_numbers({0.0F}), "an answer of another form"},
        {fake_numbers({0.0F, 0.0F, 0.0F}), "an answer of another form"},
        {fake_error("no angles today"), "ALMotion.getAngles: no angles today"},
        {FakeAnswer{}, "not what it should be"}}) {
    const auto works =
        std::exchange(method("getAngles").handler, [&c](QiReader) { return c.answer; });
    EXPECT_TRUE(turn_until_fault(c.told)) << c.told;
    states_.clear();
    turn_for(0.1);
    EXPECT_THAT(states_, IsEmpty()) << c.told;
    method("getAngles").handler = works;
    EXPECT_TRUE(turn_until([this] { return dut().health().words.empty(); }))
        << dut().health().words;
  }
  EXPECT_THAT(dut().notes(), HasSubstr("answers passed over"));
}

TEST_F(NaoqiHeadFaults, AnglesThatTakeTooLongAreOfNoUse) {
  start();
  robot_.answers = false;
  turn_for(0.3);
  states_.clear();
  robot_.answers = true;
  EXPECT_TRUE(turn_until_fault("the head's angles took 0."));
  EXPECT_THAT(states_, IsEmpty());
  turn_for(0.1);
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, WhenSomebodyElseMovesItTheHeadIsLetBeAndThenUsedAgain) {
  start();
  command(0.25, 0.125);
  turn_for(1.0);
  motion_.angles = {0.75F, 0.125F};
  EXPECT_TRUE(turn_until_fault("somebody else moves the head"));
  // Where it is now it is told to stay.
  turn_for(0.1);
  ASSERT_EQ(motion_.commands.size(), 2U);
  EXPECT_EQ(motion_.commands[1].target, (PerJoint{0.75F, 0.125F}));
  command(0.375, 0.125);
  turn_for(0.3);
  EXPECT_EQ(motion_.commands.size(), 2U);
  turn_for(1.0);
  ASSERT_EQ(motion_.commands.size(), 3U);
  EXPECT_EQ(motion_.commands[2].target, (PerJoint{0.375F, 0.125F}));
  turn_for(3.0);
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, AHeadThatWasNeverCommandedMayBeMovedByAnybody) {
  start();
  motion_.angles = {0.75F, 0.125F};
  EXPECT_TRUE(turn_until_fault("somebody else moves the head"));
  turn_for(5.0);
  EXPECT_EQ(dut().health().words, "");
  EXPECT_THAT(motion_.commands, IsEmpty());
}

TEST_F(NaoqiHeadFaults, WhoeverGoesOnMovingTheHeadIsFollowed) {
  start();
  command(0.25, 0.125);
  turn_for(1.0);
  motion_.angles[0] = 0.5F;
  EXPECT_TRUE(turn_until_fault("somebody else moves the head"));
  for (int i = 0; i < 9; ++i, turn_for(0.1)) motion_.angles[0] += 0.0625F;
  turn_for(1.0);
  EXPECT_EQ(motion_.commands.back().target, motion_.angles);  // it is not pulled back
  for (int i = 0; i < 20; ++i, turn_for(0.1))
    EXPECT_EQ(dut().health().words.find("stuck"), std::string::npos) << dut().health().words;
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, AStiffnessThatIsNoneIsNotPassedOn) {
  for (const PerJoint& none : {PerJoint{std::nanf(""), 0.5F}, {0.5F, 1.5F}, {-0.5F, 0.5F}}) {
    motion_.stiffness = none;
    EXPECT_TRUE(turn_until_fault("the robot says the head's stiffness is ("));
  }
  EXPECT_EQ(robot_.calls_of("setStiffnesses"), 0);
  motion_.stiffness = {0.0F, 0.0F};
  EXPECT_TRUE(turn_until([this] { return motion_.stiffness[0] > 0.0F; }));
}

TEST_F(NaoqiHeadFaults, ABreathingThatIsNotToldIsAskedForAgain) {
  const auto works = method("getBreathEnabled").handler;
  method("getBreathEnabled").handler = [](QiReader) { return fake_silence(); };
  EXPECT_TRUE(turn_until_fault("ALMotion.getBreathEnabled: no answer in time"));
  method("getBreathEnabled").handler = works;
  EXPECT_TRUE(turn_until([this] { return !motion_.breathing; }));
  turn_for(0.1);
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, AConnectionThatIsLostAtTheEndIsWaitedFor) {
  start();
  robot_.close_all();
  EXPECT_TRUE(turn_until_fault("closed the connection"));
  EXPECT_EQ(dut().health().kind, drivers::HealthKind::lost);
  end();
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.0F, 0.0F}));
  EXPECT_TRUE(motion_.breathing);
}

TEST_F(NaoqiHeadFaults, AStiffnessThatIsTakenAwayIsNotGivenBackByForce) {
  start();
  motion_.stiffness = {0.0F, 0.0F};
  EXPECT_TRUE(turn_until_fault("has lost its stiffness"));
  turn_for(3.0);
  EXPECT_EQ(robot_.calls_of("setStiffnesses"), 1);
  EXPECT_THAT(dut().health().words, HasSubstr("has lost its stiffness"));
  EXPECT_EQ(dut().health().kind, drivers::HealthKind::disobeyed);
  motion_.stiffness = {0.7F, 0.7F};
  turn_for(4.0);
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiHeadFaults, AHotHeadIsNotMoved) {
  start();
  motion_.celsius = {40.0F, 90.0F};
  EXPECT_TRUE(turn_until_fault("HeadPitch is too hot: 90 C"));
  command(0.25, 0.125);
  turn_for(2.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
}

TEST_F(NaoqiHeadFaults, AMemoryThatGoesDoesNotCoolTheHead) {
  start();
  motion_.celsius = {40.0F, 90.0F};
  EXPECT_TRUE(turn_until_fault("HeadPitch is too hot: 90 C"));
  method("getListData").handler = [](QiReader) { return fake_error("no memory"); };
  turn_for(5.0);
  EXPECT_EQ(states_.back().temperature_c, 90.0F);
  EXPECT_THAT(dut().health().words, HasSubstr("HeadPitch is too hot: 90 C"));
  turn_for(6.5);
  EXPECT_TRUE(std::isnan(states_.back().temperature_c));
}

TEST_F(NaoqiHeadFaults, WithoutAMemoryThereAreNoTemperatures) {
  method("getListData").name = "getNothing";
  start();
  EXPECT_TRUE(std::isnan(states_.back().temperature_c));
  EXPECT_THAT(dut().notes(), HasSubstr("no temperatures: ALMemory"));
}

TEST_F(NaoqiHeadFaults, ARobotThatComesBackIsTakenOverAgain) {
  start();
  command(0.25, 0.125);
  turn_for(0.1);
  robot_.close_all();
  EXPECT_TRUE(turn_until_fault("ALMotion"));
  // Another start of the robot: as at first.
  motion_.stiffness = {0.0F, 0.0F};
  motion_.breathing = true;
  states_.clear();
  EXPECT_TRUE(turn_until([this] { return motion_.stiffness[0] > 0.0F && !motion_.breathing; }));
  turn_for(1.0);
  EXPECT_EQ(dut().health().words, "");
  EXPECT_EQ(motion_.commands.size(), 1U);  // and nothing is told twice
  end();
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.0F, 0.0F}));
  EXPECT_TRUE(motion_.breathing);
}

TEST_F(NaoqiHeadFaults, ARefusedCommandIsTold) {
  start();
  method("setAngles").handler = [](QiReader) { return fake_error("not today"); };
  command(0.25, 0.125);
  EXPECT_TRUE(turn_until_fault("ALMotion.setAngles: not today"));
}

}  // namespace
}  // namespace gazed::naoqi::head_faults_test
