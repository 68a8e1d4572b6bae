// Everything that can go wrong with LoLA and its robot: noticed, told, and over within two seconds
// of its end, with no command lost that the agent still
// waits for, and none carried out again.
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ostream>
#include <string>

#include "tests/unit/drivers/lola/rig.hpp"

namespace gazed::lola::faults_test {
namespace {

using lola_robot::Fault;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double recovery_s = 2.0;  // a choice: twice LolaLink's longest back-off

class Faults : public LolaRig {
 protected:
  /// Until a state comes again; the seconds that it took.
  double seconds_to_recover() {
    const std::size_t states = states_.size();
    const std::int64_t start_us = now_us_;
    for (int i = 0; i < cycles(10.0) && states_.size() == states; ++i) run_cycles(1);
    return 1e-6 * static_cast<double>(now_us_ - start_us);
  }
};

/// Short ones of the connection: survived within the time that the agent waits for a head (2 s), so
/// that a command that is under way arrives.
struct ShortFault {
  const char* name;
  Fault fault;
  int cycles;
};
void PrintTo(const ShortFault& fault, std::ostream* out) {
  *out << fault.name;
}
class ShortFaults : public Faults, public testing::WithParamInterface<ShortFault> {};

TEST_P(ShortFaults, ACommandUnderWayArrivesAndIsNotRepeated) {
  start();
  command(0.8, 0.2);
  run(0.1);
  EXPECT_GT(yaw(), 0.02);
  EXPECT_LT(yaw(), 0.7);
  robot_.suffer(GetParam().fault, GetParam().cycles);
  run_cycles(GetParam().cycles);
  EXPECT_LT(seconds_to_recover(), recovery_s);
  run(1.5);
  EXPECT_NEAR(yaw(), 0.8, there_rad);
  EXPECT_THAT(head_.health().words, IsEmpty());
  run(2.0);
  EXPECT_EQ(robot_.crash(), "");
  EXPECT_NEAR(ordered_yaw(), 0.8, there_rad);
}

TEST_P(ShortFaults, BodyAndHeadAreNeverToldAnythingElse) {
  start();
  command(0.3, 0.1);
  run(1.0);
  orders_.clear();
  robot_.suffer(GetParam().fault, GetParam().cycles);
  run(2.0);
  ASSERT_FALSE(orders_.empty());
  for (const lola_robot::Order& order : orders_) {
    ASSERT_NEAR(order.position[0], 0.3, there_rad);
    ASSERT_NEAR(order.position[10], 0.9, there_rad);
    ASSERT_FLOAT_EQ(order.stiffness[10], 0.8F);
  }
}

INSTANTIATE_TEST_SUITE_P(Connection, ShortFaults,
                         testing::Values(ShortFault{"End", Fault::eof, 1},
                                         ShortFault{"AwayFor700ms", Fault::down, 60},
                                         ShortFault{"SilentFor500ms", Fault::stall, 40},
                                         ShortFault{"SilentFor1200ms", Fault::stall, 100},
                                         ShortFault{"DeafFor600ms", Fault::deaf, 50},
                                         ShortFault{"HeldBackFor360ms", Fault::hold_back, 30},
                                         ShortFault{"InPiecesFor1200ms", Fault::pieces, 100},
                                         ShortFault{"PacketTooShort", Fault::cut_short, 1},
                                         ShortFault{"PacketTooLong", Fault::too_long, 1},
                                         ShortFault{"Garbage", Fault::garbage, 1},
                                         ShortFault{"OtherMessages", Fault::stranger, 3},
                                         ShortFault{"NaNFor600ms", Fault::nan, 50}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(Faults, NobodyThere) {
  robot_.suffer(Fault::down, cycles(5.0));
  run(3.0);
  EXPECT_TRUE(states_.empty());
  EXPECT_THAT(head_.health().words, HasSubstr(path_ + ": No such file or directory"));
  EXPECT_EQ(head_.health().kind, drivers::HealthKind::lost);
  run(2.0);
  EXPECT_LT(seconds_to_recover(), recovery_s);
  EXPECT_THAT(head_.health().words, IsEmpty());
}

TEST_F(Faults, ReconnectsAfterATenthOfASecondAndNotBefore) {
  start();
  robot_.suffer(Fault::eof);
  run_cycles(8);
  EXPECT_EQ(robot_.counts().connections, 1);
  EXPECT_THAT(head_.health().words, HasSubstr("LoLA has closed the connection"));
  run_cycles(3);
  EXPECT_EQ(robot_.counts().connections, 2);
}

TEST_F(Faults, AConnectionThatIsLostAfterGoodStatesIsLostOnce) {
  start();
  run_cycles(1, false);
  robot_.suffer(Fault::garbage);
  run_cycles(1);
  EXPECT_THAT(head_.health().words, HasSubstr("what came is no state of LoLA's"));
  run_cycles(11);
  EXPECT_EQ(robot_.counts().connections, 2) << "0.1 s later";
}

TEST_F(Faults, AStalledRobotIsConnectedToAnew) {
  start();
  robot_.suffer(Fault::stall, cycles(3.0));
  run(2.5);
  EXPECT_THAT(head_.health().words, HasSubstr("LoLA says nothing for 1 s"));
  EXPECT_GT(silent_s(), 2.0);
  run(0.5);
  EXPECT_LT(seconds_to_recover(), recovery_s);
  run(1.0);
  EXPECT_THAT(head_.notes(), HasSubstr("lost"));
}

TEST_F(Faults, AfterALongSilenceTheOldCommandIsForgotten) {
  start();
  command(0.8, 0.0);
  run(0.1);
  robot_.suffer(Fault::down, cycles(4.0));
  run(6.0);
  EXPECT_THAT(head_.health().words, IsEmpty());
  EXPECT_LT(yaw(), 0.7) << "the agent has told HEAD_FAULT and looks from where the head is";
  command(0.5, 0.0);
  run(1.5);
  EXPECT_NEAR(yaw(), 0.5, there_rad);
}

TEST_F(Faults, ImplausibleStatesAreNeitherAnsweredNorHandedOn) {
  start();
  const std::int64_t orders = robot_.counts().orders;
  const std::size_t states = states_.size();
  robot_.suffer(Fault::nan, cycles(3.0));
  run(3.0);
  EXPECT_LE(robot_.counts().orders - orders, 1);
  EXPECT_EQ(states_.size(), states);
  EXPECT_EQ(head_.health().words, "HeadYaw is said to be at nan rad");
  EXPECT_EQ(head_.health().kind, drivers::HealthKind::refused);
  EXPECT_LT(seconds_to_recover(), recovery_s);
  EXPECT_THAT(head_.health().words, IsEmpty());
  EXPECT_EQ(robot_.counts().connections, 1);
}

TEST_F(Faults, ACommandGivenBeforeImplausibleStatesIsForgottenAfterThem) {
  start();
  command(0.8, 0.0);
  run(0.1);
  robot_.suffer(Fault::nan, cycles(3.0));
  run(5.0);
  EXPECT_THAT(head_.health().words, IsEmpty());
  EXPECT_LT(yaw(), 0.7);
}

TEST_F(Faults, AfterALongDeafnessTheHeadIsTakenFromWhereItIs) {
  start();
  robot_.suffer(Fault::deaf, cycles(6.0));
  command(2.0, 0.0);
  run(6.0);
  EXPECT_NEAR(yaw(), 0.0, there_rad);
  EXPECT_THAT(head_.notes(), HasSubstr("lost"));
  orders_.clear();
  run(2.0);
  ASSERT_FALSE(orders_.empty());
  for (const lola_robot::Order& order : orders_) EXPECT_NEAR(order.position[0], 0.0, 0.51);
  EXPECT_NEAR(yaw(), 0.0, 0.1) << "given up long ago";
  EXPECT_THAT(head_.health().words, IsEmpty());
}

TEST_F(Faults, TheSetPointDoesNotRunAwayFromAHeadThatDoesNotFollow) {
  start();
  robot_.suffer(Fault::stuck, cycles(1.0));
  command(2.0, 0.0, 1.0);
  run(0.9);
  EXPECT_GT(ordered_yaw(), 0.4);
  EXPECT_LT(ordered_yaw(), 0.6);
  run(3.0);
  EXPECT_NEAR(yaw(), 2.0, there_rad);
}

TEST_F(Faults, AFallenRobotIsToldNothing) {
  start();
  robot_.suffer(Fault::fallen, cycles(3.0));
  run_cycles(2);
  const std::int64_t orders = robot_.counts().orders;
  command(0.5, 0.0);
  run(2.9);
  EXPECT_EQ(robot_.counts().orders, orders);
  EXPECT_GT(silent_s(), 2.0) << "which the agent tells as HEAD_FAULT";
  EXPECT_THAT(head_.health().words,
              HasSubstr("the torso leans by 1.40 rad, over 0.79: nothing is sent"));
  EXPECT_EQ(head_.health().kind, drivers::HealthKind::no_data);
  EXPECT_LT(seconds_to_recover(), recovery_s);
  run(2.0);
  EXPECT_THAT(head_.health().words, IsEmpty());
  EXPECT_NEAR(yaw(), 0.0, there_rad) << "told while it lay there, and given up since";
}

TEST_F(Faults, ALimpHeadIsNoticedAndTriedAgain) {
  start();
  robot_.suffer(Fault::limp, cycles(1.4));
  command(0.5, 0.0);
  run(1.0);
  EXPECT_THAT(head_.health().words, HasSubstr("HeadYaw has lost its stiffness: 0.00, told 0.70"));
  run(0.4);
  run(recovery_s);
  EXPECT_NEAR(yaw(), 0.5, there_rad);
  run(1.0);
  EXPECT_THAT(head_.health().words, IsEmpty());
}

TEST_F(Faults, AStuckJointIsNotPushedOn) {
  start();
  robot_.suffer(Fault::stuck, cycles(2.0));
  command(0.5, 0.1);
  run(1.4);
  EXPECT_THAT(head_.health().words, HasSubstr("HeadYaw is stuck: at 0.000 rad"));
  EXPECT_EQ(head_.health().kind, drivers::HealthKind::disobeyed);
  EXPECT_LT(ordered_yaw(), 0.01) << "told to be where it is";
  run(0.6);
  run(recovery_s);
  EXPECT_NEAR(yaw(), 0.5, there_rad);
  run(1.0);
  EXPECT_THAT(head_.health().words, IsEmpty());
}

TEST_F(Faults, AHotHeadRestsUntilItHasCooled) {
  start();
  robot_.suffer(Fault::hot, cycles(5.0));
  run(0.5);
  command(0.5, 0.0);
  run(4.0);
  EXPECT_THAT(head_.health().words, HasSubstr("HeadPitch is too hot: 85 C, over 75 C"));
  EXPECT_NEAR(yaw(), 0.0, there_rad);
  run(0.5);
  run(3.0);
  EXPECT_NEAR(yaw(), 0.0, there_rad) << "nobody waits for that command any more";
  EXPECT_THAT(head_.health().words, IsEmpty());
  command(0.5, 0.0);
  run(1.0);
  EXPECT_NEAR(yaw(), 0.5, there_rad);
}

TEST_F(Faults, WhoMovesTheHeadIsGivenWay) {
  start();
  command(0.2, 0.0);
  run(1.0);
  robot_.suffer(Fault::pushed, cycles(3.0));
  run(0.5);
  EXPECT_THAT(head_.health().words, HasSubstr("somebody else moves the head: HeadYaw at 0.5"));
  EXPECT_NEAR(ordered_yaw(), 0.5, there_rad) << "nothing is pushed against";
  run(4.5);
  EXPECT_NEAR(yaw(), 0.5, there_rad) << "what was done is not done again";
  EXPECT_THAT(head_.health().words, IsEmpty());
  command(0.0, 0.0);
  run(1.0);
  EXPECT_NEAR(yaw(), 0.0, there_rad);
}

}  // namespace
}  // namespace gazed::lola::faults_test
