// What kind of robot it is, before its head is touched.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/unit/drivers/naoqi/head_rig.hpp"

namespace gazed::naoqi::robot_model_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

using NaoqiModel = NaoqiHeadRig;

TEST_F(NaoqiModel, ARobotThatIsNoNaoIsRefusedAndLeftAsItIs) {
  motion_.model = "juliettey20";
  EXPECT_TRUE(turn_until_fault("the robot says that it is a juliettey20, not a NAO"));
  EXPECT_EQ(dut().health().kind, drivers::HealthKind::refused);
  command(0.25, 0.125);
  turn_for(3.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
  EXPECT_THAT(motion_.switched, IsEmpty());
  EXPECT_EQ(motion_.stiffness[0], 0.0F);
  EXPECT_THAT(dut().health().words, HasSubstr("not a NAO"));
}

TEST_F(NaoqiModel, ARobotThatDoesNotAnswerWhatItIsIsLeftAsItIsUntilItDoes) {
  const auto answers = method("getRobotConfig").handler;
  method("getRobotConfig").handler = [](QiReader) { return fake_silence(); };
  EXPECT_TRUE(turn_until_fault("the robot has not said yet what it is"));
  command(0.25, 0.125);
  turn_for(3.0);
  EXPECT_THAT(motion_.commands, IsEmpty());
  EXPECT_THAT(motion_.switched, IsEmpty());
  EXPECT_EQ(motion_.stiffness[0], 0.0F);
  motion_.model = "juliettey20";
  method("getRobotConfig").handler = answers;
  EXPECT_TRUE(turn_until_fault("the robot says that it is a juliettey20, not a NAO"));
  EXPECT_THAT(motion_.switched, IsEmpty());
}

TEST_F(NaoqiModel, ANaoThatSaysLateWhatItIsIsTaken) {
  const auto answers = method("getRobotConfig").handler;
  method("getRobotConfig").handler = [](QiReader) { return fake_silence(); };
  EXPECT_TRUE(turn_until_fault("the robot has not said yet what it is"));
  method("getRobotConfig").handler = answers;
  EXPECT_TRUE(turn_until([this] {
    if (motion_.stiffness[0] == 0.0F) return false;
    command(0.25, 0.125);
    return !motion_.commands.empty();
  }));
  EXPECT_EQ(dut().health().words, "");
}

TEST_F(NaoqiModel, ARobotThatDoesNotSayWhatItIsMayBeANao) {
  for (const std::string model : {"", "NAO_H21"}) {
    motion_.model = model;
    motion_.commands.clear();
    start();
    command(0.25, 0.125);
    EXPECT_TRUE(turn_until([this] { return motion_.commands.size() == 1; })) << model;
    end();
  }
  method("getRobotConfig").handler = [](QiReader) { return fake_error("no such thing"); };
  motion_.commands.clear();
  start();
  command(0.125, 0.0);
  EXPECT_TRUE(turn_until([this] { return motion_.commands.size() == 1; }));
}

}  // namespace
}  // namespace gazed::naoqi::robot_model_test
