#include "drivers/lola/lola_head.hpp"

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

#include "agent/geometry/limits.hpp"

#include "tests/unit/allocations.hpp"
#include "tests/unit/drivers/lola/rig.hpp"

namespace gazed::lola::lola_head_test {
namespace {

using ::testing::HasSubstr;

class Lola : public LolaRig {};
class ShuffledLola : public LolaRig {
 protected:
  ShuffledLola() : LolaRig(true) {}
};
class ReleasingLola : public LolaRig {
 protected:
  ReleasingLola() : LolaRig(false, OtherJoints::release) {}
};

TEST_F(Lola, StatesComeAsMeasuredWithTheirTimes) {
  start();
  ASSERT_GT(states_.size(), 50U);
  for (std::size_t i = 1; i < states_.size(); ++i)
    EXPECT_EQ(states_[i].utime_us - states_[i - 1].utime_us, 12'000);
  EXPECT_EQ(states_.back().utime_us, 1'700'000'000'000'000 + now_us_);
  EXPECT_EQ(states_.back().temperature_c, 38.0F);
  EXPECT_TRUE(std::isnan(states_.back().velocity_rad_s.yaw_rad)) << "LoLA does not measure it";
}

TEST_F(Lola, OneOrderAnswersEachState) {
  start();
  run(2.0);
  EXPECT_EQ(robot_.counts().connections, 1);
  // The first states are only compared; the last answer is read in the robot's next cycle.
  EXPECT_EQ(robot_.counts().states - robot_.counts().orders, BodyControl::agreeing_states);
  EXPECT_EQ(robot_.crash(), "");
}

TEST_F(Lola, TheHeadGoesWhereItIsTold) {
  start();
  command(0.5, -0.2);
  run(1.0);
  EXPECT_NEAR(states_.back().measured.yaw_rad, 0.5, there_rad);
  EXPECT_NEAR(states_.back().measured.pitch_rad, -0.2, there_rad);
  EXPECT_EQ(head_.health().words, "");
}

TEST_F(ShuffledLola, KeysMayComeInAnyOrder) {
  start();
  command(-0.4, 0.1);
  run(1.0);
  EXPECT_NEAR(states_.back().measured.yaw_rad, -0.4, there_rad);
}

TEST_F(Lola, TheHeadIsStiffenedSlowlyBeforeItMoves) {
  command(0.5, 0.0);
  run(0.4);
  EXPECT_EQ(ordered_yaw(), 0.0) << "not stiff yet";
  for (std::size_t i = 1; i < orders_.size(); ++i)
    EXPECT_LE(orders_[i].stiffness[0] - orders_[i - 1].stiffness[0], 0.02F);
  run(1.0);
  EXPECT_FLOAT_EQ(orders_.back().stiffness[0], 0.7F);
  EXPECT_NEAR(yaw(), 0.5, there_rad);
}

TEST_F(Lola, EachJointOfTheHeadBeginsWithItsOwnStiffness) {
  robot_.sensors().stiffness[0] = 0.9F;
  robot_.sensors().stiffness[1] = 0.2F;
  run(1.0);
  EXPECT_NEAR(orders_.front().stiffness[0], 0.9, 0.02);
  EXPECT_NEAR(orders_.front().stiffness[1], 0.2, 0.02);
  EXPECT_FLOAT_EQ(orders_.back().stiffness[0], 0.7F);
  EXPECT_FLOAT_EQ(orders_.back().stiffness[1], 0.7F);
}

TEST_F(Lola, AHeadBesideItsLimitsIsDrawnBackSoftly) {
  robot_.bend(0, 1.5);
  robot_.bend(1, 0.5);  // where the shoulder is
  robot_.sensors().stiffness[0] = robot_.sensors().stiffness[1] = 0.7F;
  run(1.0);
  EXPECT_FALSE(geometry::HeadLimits().contains({1.5, 0.5}));
  EXPECT_LT(orders_.front().position[1], 0.45F);
  EXPECT_LT(orders_.front().stiffness[0], 0.02F);
  EXPECT_LT(orders_.front().stiffness[1], 0.02F);
  EXPECT_FLOAT_EQ(orders_.back().stiffness[1], 0.7F);
}

TEST_F(Lola, OneThatWasNeverToldAnythingIsLeftAtOnce) {
  run(0.15);
  head_.hold();
  EXPECT_EQ(robot_.counts().orders, 0);
  EXPECT_EQ(head_.notes(), "");
}

/// The robot goes on with every look at the clock.
class LolaAtItsEnd : public LolaRig {
 protected:
  drivers::Clocks robots_clock() {
    return {[this] {
              robot_.cycle();
              return now_us_ += 12'000;
            },
            [this] { return now_us_; }};
  }
  void serve(LolaHead& head) {
    for (int i = 0; i < 100; ++i) {
      head.serve();
      while (head.next_state()) {
      }
    }
    ASSERT_FLOAT_EQ(orders_.back().stiffness[0], 0.7F);
  }
};

TEST_F(LolaAtItsEnd, LetsTheHeadGoWithoutBeingAsked) {
  {
    LolaHead head({path_, OtherJoints::hold}, robots_clock());
    serve(head);
  }
  robot_.cycle();
  EXPECT_EQ(orders_.back().stiffness[0], 0.0F);
  EXPECT_FLOAT_EQ(orders_.back().stiffness[10], 0.8F);
}

TEST_F(LolaAtItsEnd, ToldToHoldItLetsGoAndHasNothingToNote) {
  LolaHead head({path_, OtherJoints::hold}, robots_clock());
  serve(head);
  head.hold();
  robot_.cycle();
  EXPECT_EQ(orders_.back().stiffness[0], 0.0F);
  EXPECT_EQ(head.notes(), "");
}

TEST_F(LolaAtItsEnd, NotesAHeadThatCouldNotBeLetGo) {
  LolaHead head({path_, OtherJoints::hold}, robots_clock());
  serve(head);
  robot_.suffer(lola_robot::Fault::fallen, 1000);
  head.hold();
  EXPECT_EQ(head.notes(), "lola: the head was not given back its stiffness");
}

TEST_F(Lola, TheRestOfTheBodyKeepsWhatItWasFoundWith) {
  robot_.sensors().stiffness[7] = -1.0F;  // off, as LoLA says it
  robot_.sensors().stiffness[20] = 0.25F;
  const lola_robot::Sensors found = robot_.sensors();
  start();
  command(0.5, 0.1);
  run(1.0);
  for (const lola_robot::Order& order : orders_) {
    for (std::size_t i = 2; i < lola_robot::joints; ++i) {
      ASSERT_NEAR(order.position[i], found.position[i], 0.001) << i;  // its encoders' steps
      ASSERT_EQ(order.position[i], orders_.front().position[i]);
      ASSERT_EQ(order.stiffness[i], found.stiffness[i]);
    }
  }
}

TEST_F(ReleasingLola, TheRestOfTheBodyIsLetGo) {
  start();
  run(0.5);
  for (std::size_t i = 2; i < lola_robot::joints; ++i) EXPECT_EQ(orders_.back().stiffness[i], 0.0F);
  EXPECT_FLOAT_EQ(orders_.back().stiffness[0], 0.7F);
}

TEST_F(Lola, ALatePauseLosesNoStateAndIsAnsweredOnce) {
  start();
  const std::size_t states = states_.size();
  const std::int64_t orders = robot_.counts().orders;
  run_cycles(10, false);  // the loop computes
  run_cycles(1);
  EXPECT_EQ(states_.size() - states, 11U);
  for (std::size_t i = states; i < states_.size(); ++i)
    EXPECT_EQ(states_[i].utime_us - states_[i - 1].utime_us, 12'000);
  run_cycles(1);
  EXPECT_EQ(robot_.counts().orders - orders, 2) << "the last one before, and one after the pause";
}

// The socket's buffer is full, and LoLA ignores whoever did not read.
TEST_F(Lola, APauseThatLoLADoesNotForgiveEndsWithANewConnection) {
  start();
  const std::int64_t before_us = states_.back().utime_us;
  const std::size_t states = states_.size();
  run_cycles(2000, false);
  run_cycles(1);
  const auto waited = static_cast<std::int64_t>(states_.size() - states);
  EXPECT_GT(waited, 20);
  EXPECT_EQ(states_.back().utime_us - before_us, 12'000 * waited) << "they are that old";
  run(1.3);
  EXPECT_EQ(head_.health().words, "");
  EXPECT_EQ(robot_.counts().connections, 2);
  EXPECT_LT(silent_s(), 0.1);
}

TEST_F(Lola, NoCommandThatIsNoneIsObeyed) {
  start();
  command(NAN, 0.0);
  command(0.3, 0.0, -1.0);
  run(1.0);
  EXPECT_NEAR(yaw(), 0.0, there_rad);
  EXPECT_THAT(head_.notes(), HasSubstr("2 commands refused"));
}

TEST_F(Lola, ServesWithoutAllocating) {
  start();
  run(1.0);
  command(0.4, 0.1);
  long allocated = 0;
  for (int i = 0; i < 100; ++i) {
    robot_.cycle();
    now_us_ += 12'000;
    const long before = test::allocations();
    head_.serve();
    while (head_.next_state()) {
    }
    allocated += test::allocations() - before;
  }
  EXPECT_EQ(allocated, 0);
  EXPECT_NEAR(yaw(), 0.4, there_rad);
}

TEST_F(Lola, CalledTwiceForOneStateItAnswersOnce) {
  start();
  const std::int64_t orders = robot_.counts().orders;
  for (int i = 0; i < 20; ++i) {
    head_.serve();
    run_cycles(1);
    head_.serve();
  }
  EXPECT_EQ(robot_.counts().orders - orders, 20);
}

TEST(LolaSocket, APathThatNoSocketCanHaveIsRefused) {
  EXPECT_THROW(LolaHead({std::string(200, 'x'), OtherJoints::hold}), std::invalid_argument);
  EXPECT_THROW(LolaHead({"", OtherJoints::hold}), std::invalid_argument);
}

}  // namespace
}  // namespace gazed::lola::lola_head_test
