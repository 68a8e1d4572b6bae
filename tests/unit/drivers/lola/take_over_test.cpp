// What the body is held to, and when a robot that was held before is not held again.
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/drivers/lola/rig.hpp"

namespace gazed::lola::take_over_test {
namespace {

using lola_robot::Fault;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TakeOver : public LolaRig {};

TEST_F(TakeOver, ABlankFirstPacketDoesNotDecideTheBody) {
  robot_.suffer(Fault::blank, cycles(0.5));
  run(0.45);
  EXPECT_EQ(head_.health().words, "HeadYaw is said to have 0 C");
  run(1.0);
  ASSERT_FALSE(orders_.empty());
  for (const lola_robot::Order& order : orders_) {
    ASSERT_FLOAT_EQ(order.stiffness[10], 0.8F);
    ASSERT_NEAR(order.position[10], 0.9, there_rad);
  }
}

TEST_F(TakeOver, FirstStatesThatDifferAreWaitedOut) {
  robot_.sensors().stiffness[10] = 0.0F;
  run(0.15);  // connected, and some states have come
  EXPECT_EQ(head_.health().words, "");
  robot_.sensors().stiffness[10] = 0.8F;
  run_cycles(1);
  EXPECT_THAT(head_.health().words,
              HasSubstr("LKneePitch changes its stiffness from 0.00 to 0.80"));
  run_cycles(BodyControl::agreeing_states - 1);
  EXPECT_TRUE(orders_.empty());
  robot_.bend(10, 0.6);
  run_cycles(1);
  EXPECT_THAT(head_.health().words,
              HasSubstr("LKneePitch moves, from 0.90 to 0.60 rad; nothing is sent"));
  run(1.0);
  ASSERT_FALSE(orders_.empty());
  EXPECT_FLOAT_EQ(orders_.front().stiffness[10], 0.8F);
  EXPECT_NEAR(orders_.front().position[10], 0.6, there_rad);
}

TEST_F(TakeOver, ImplausibleFirstValuesAreWaitedOut) {
  robot_.suffer(Fault::nan, cycles(1.0));
  run(1.0);
  EXPECT_EQ(robot_.counts().orders, 0);
  EXPECT_TRUE(states_.empty());
  run(1.0);
  EXPECT_GT(robot_.counts().orders, 0);
}

TEST_F(TakeOver, ALegThatWasMovedMeanwhileIsNotPulledBack) {
  start();
  robot_.suffer(Fault::down, cycles(1.0));
  run(0.5);
  robot_.bend(10, 0.0);
  const std::int64_t orders = robot_.counts().orders;
  run(3.0);
  EXPECT_EQ(robot_.counts().orders, orders);
  EXPECT_THAT(head_.health().words,
              HasSubstr("LKneePitch is at 0.00 rad, and was at 0.90 when it was"));
  robot_.bend(10, 0.9);
  run(1.0);
  EXPECT_THAT(head_.health().words, IsEmpty());
}

TEST_F(TakeOver, ALegThatWasLoosenedMeanwhileIsNotStiffened) {
  start();
  robot_.suffer(Fault::down, cycles(1.0));
  run(0.5);
  robot_.loosen(10);
  const std::int64_t orders = robot_.counts().orders;
  run(3.0);
  EXPECT_EQ(robot_.counts().orders, orders);
  EXPECT_THAT(head_.health().words,
              HasSubstr("LKneePitch has lost its stiffness meanwhile, 0.00 of 0.80"
                        ": start gazed anew"));
}

}  // namespace
}  // namespace gazed::lola::take_over_test
