#include "drivers/naoqi/naoqi_head.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <optional>

#include "tests/unit/allocations.hpp"
#include "tests/unit/naoqi/fake_motion.hpp"

namespace gazed::naoqi_head_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t turn_us = 1'000;

// Time goes on by 1 ms a turn, of both clocks: the monotonic one is made to be late by 1 s, so that
// neither can stand for the other.
class NaoqiHeadTest : public testing::Test {
 protected:
  // A robot that is gone is not waited for.
  ~NaoqiHeadTest() override { robot_.close_all(); }

  NaoqiHead& dut() {
    if (!dut_) {
      dut_.emplace(NaoqiHeadSettings{.robot = {robot_.endpoint(), "", ""}},
                   Clocks{[this] { return now_us_ - 1'000'000; }, [this] { return now_us_; }});
    }
    return *dut_;
  }

  void turn() {
    robot_.serve();
    now_us_ += turn_us;
    const long before = allocations();
    while (const auto state = dut().next_state()) states_.push_back(*state);
    allocated_ += allocations() - before;
  }
  void turn_for(double seconds) {
    for (const std::int64_t end = now_us_ + std::llround(1e6 * seconds); now_us_ < end;) turn();
  }
  template <typename Condition>
  bool turn_until(Condition condition) {
    for (int i = 0; i < 5'000 && !condition(); ++i) turn();
    return condition();
  }
  bool turn_until_fault(const std::string& part) {
    return turn_until([&] { return dut().fault().find(part) != std::string::npos; });
  }
  /// The head is taken over, and the guard has seen it for a while.
  void start() {
    turn_for(1.0);
    ASSERT_THAT(states_, ::testing::Not(IsEmpty())) << dut().fault();
    ASSERT_EQ(dut().fault(), "");
  }
  void command(double yaw_rad, double pitch_rad, double speed_fraction = 0.5) {
    dut().command({now_us_, {yaw_rad, pitch_rad}, speed_fraction});
  }
  FakeNaoqi::Method& method(const std::string& name) {
    return *std::ranges::find(robot_.methods, name, &FakeNaoqi::Method::name);
  }

  FakeNaoqi robot_;
  FakeMotion motion_{robot_};
  std::int64_t now_us_ = 1'700'000'000'000'000;
  std::vector<HeadState> states_;
  long allocated_ = 0;
  std::optional<NaoqiHead> dut_;
};

TEST_F(NaoqiHeadTest, StatesAreWhatTheSensorsSay) {
  start();
  const HeadState& state = states_.back();
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

TEST_F(NaoqiHeadTest, ALoopThatWasAwayIsNoFaultOfTheRobot) {
  start();
  states_.clear();
  const int asked = robot_.calls_of("getAngles");
  turn_until([&] { return robot_.calls_of("getAngles") > asked; });
  robot_.serve();
  now_us_ += 150'000;
  turn_until([&] { return robot_.calls_of("getAngles") > asked + 1; });
  EXPECT_EQ(dut().fault(), "");
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
  dut_.reset();
  robot_.serve();
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.2F, 0.9F}));
  EXPECT_THAT(motion_.switched, ElementsAre("Head BreathEnabled off", "Head BreathEnabled on"));
}

TEST_F(NaoqiHeadTest, WhatIsAsItShouldBeIsLeftAlone) {
  motion_.stiffness = {1.0F, 0.8F};
  motion_.breathing = false;
  start();
  dut_.reset();
  robot_.serve();
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

TEST_F(NaoqiHeadTest, AStiffnessThatCannotBeSetIsTriedAgain) {
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
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiHeadTest, ACommandIsSentOnce) {
  start();
  command(0.25, 0.125, 0.25);
  turn_for(2.0);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.25F, 0.125F}, 0.25F}));
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiHeadTest, ACommandWaitsForTheHeadToBeTakenOver) {
  command(0.25, 0.125);
  command(0.375, 0.125);  // the newest is what counts
  turn_for(1.0);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.375F, 0.125F}, 0.5F}));
}

TEST_F(NaoqiHeadTest, ACommandThatWaitsTooLongIsNeverSent) {
  start();
  robot_.answers = false;
  turn_for(0.5);
  command(0.25, 0.125);
  EXPECT_TRUE(turn_until_fault("no answer for 1.0 s"));
  turn_for(1.0);
  robot_.answers = true;
  turn_for(3.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
  EXPECT_THAT(dut().fault(), HasSubstr("a command was not sent"));
  command(0.25, 0.125);
  turn_for(0.1);
  EXPECT_EQ(motion_.commands.size(), 1U);
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiHeadTest, CommandsOutsideTheTableGoToItsEdge) {
  start();
  command(9.0, -9.0, 7.0);
  turn_for(0.1);
  ASSERT_EQ(motion_.commands.size(), 1U);
  const auto [target, speed] = motion_.commands.front();
  EXPECT_NEAR(target[0], 2.08567, 1e-6);
  EXPECT_TRUE(
      HeadLimits().contains({static_cast<double>(target[0]), static_cast<double>(target[1])}));
  EXPECT_EQ(speed, 1.0F);
}

TEST_F(NaoqiHeadTest, WhatIsNoCommandIsRefused) {
  start();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const HeadCommand& none : {HeadCommand{now_us_, {nan, 0.0}, 0.3},
                                  {now_us_, {0.0, infinite}, 0.3},
                                  {now_us_, {0.0, 0.0}, nan},
                                  {now_us_, {0.0, 0.0}, 0.0},
                                  {now_us_, {0.0, 0.0}, -0.3}}) {
    dut().command(none);
    EXPECT_THAT(dut().fault(), HasSubstr("is none"));
  }
  turn_for(0.1);
  EXPECT_THAT(motion_.commands, IsEmpty());
}

TEST_F(NaoqiHeadTest, TheRobotsNarrowerLimitsWin) {
  motion_.limits = {{{-0.5F, 0.5F}, {-0.25F, 0.25F}}};
  start();
  command(0.4375, 0.125);
  turn_for(0.1);
  EXPECT_EQ(dut().fault(), "");
  command(1.0, -0.3);
  turn_for(0.1);
  EXPECT_THAT(dut().fault(), HasSubstr("(1.000, -0.300) rad became (0.500, -0.250)"));
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.4375F, 0.125F}, 0.5F},
                                            FakeMotion::Command{{0.5F, -0.25F}, 0.5F}));
}

TEST_F(NaoqiHeadTest, LimitsThatAreNoneAreNotUsed) {
  motion_.limits = {{{0.5F, -0.5F}, {std::nanf(""), 0.2F}}};
  start();
  command(0.4375, 0.125);
  turn_for(0.1);
  EXPECT_THAT(motion_.commands, ElementsAre(FakeMotion::Command{{0.4375F, 0.125F}, 0.5F}));
  EXPECT_THAT(dut().notes(), HasSubstr("getLimits"));
}

TEST_F(NaoqiHeadTest, AnglesThatAreNoneArePassedOverAndTold) {
  start();
  struct Case {
    FakeAnswer answer;
    const char* told;
  };
  for (const Case& c : {Case{fake_numbers({std::nanf(""), 0.0F}), "said to be at (nan, 0) rad"},
                        {fake_numbers({0.0F, 4.0F}), "said to be at (0, 4) rad"},
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
    EXPECT_TRUE(turn_until([this] { return dut().fault().empty(); })) << dut().fault();
  }
  EXPECT_THAT(dut().notes(), HasSubstr("answers passed over"));
}

TEST_F(NaoqiHeadTest, AnglesThatTakeTooLongAreOfNoUse) {
  start();
  robot_.answers = false;
  turn_for(0.3);
  states_.clear();
  robot_.answers = true;
  EXPECT_TRUE(turn_until_fault("the head's angles took 0."));
  EXPECT_THAT(states_, IsEmpty());
  turn_for(0.1);
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiHeadTest, WhenSomebodyElseMovesItTheHeadIsLetBeAndThenUsedAgain) {
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
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiHeadTest, AStiffnessThatIsTakenAwayIsNotGivenBackByForce) {
  start();
  motion_.stiffness = {0.0F, 0.0F};
  EXPECT_TRUE(turn_until_fault("has lost its stiffness"));
  turn_for(3.0);
  EXPECT_EQ(robot_.calls_of("setStiffnesses"), 1);
  EXPECT_THAT(dut().fault(), HasSubstr("has lost its stiffness"));
  motion_.stiffness = {0.7F, 0.7F};
  turn_for(4.0);
  EXPECT_EQ(dut().fault(), "");
}

TEST_F(NaoqiHeadTest, AHotHeadIsNotMoved) {
  start();
  motion_.celsius = {40.0F, 90.0F};
  EXPECT_TRUE(turn_until_fault("HeadPitch is too hot: 90 C"));
  command(0.25, 0.125);
  turn_for(2.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
}

TEST_F(NaoqiHeadTest, WithoutAMemoryThereAreNoTemperatures) {
  method("getListData").name = "getNothing";
  start();
  EXPECT_TRUE(std::isnan(states_.back().temperature_c));
  EXPECT_THAT(dut().notes(), HasSubstr("no temperatures: ALMemory"));
}

TEST_F(NaoqiHeadTest, ARobotThatComesBackIsTakenOverAgain) {
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
  EXPECT_EQ(dut().fault(), "");
  EXPECT_EQ(motion_.commands.size(), 1U);  // and nothing is told twice
  dut_.reset();
  robot_.serve();
  EXPECT_EQ(motion_.stiffness, (PerJoint{0.0F, 0.0F}));
  EXPECT_TRUE(motion_.breathing);
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

TEST_F(NaoqiHeadTest, ARefusedCommandIsTold) {
  start();
  method("setAngles").handler = [](QiReader) { return fake_error("not today"); };
  command(0.25, 0.125);
  EXPECT_TRUE(turn_until_fault("ALMotion.setAngles: not today"));
}

}  // namespace
}  // namespace gazed::naoqi_head_test
