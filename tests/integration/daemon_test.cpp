// gazed as a user runs it.
#include <cmath>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "drivers/exclusive.hpp"

#include "tests/integration/program.hpp"
#include "tests/integration/report_tests.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::integration {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

// In-process LCM: these tests neither need nor disturb a network.
const std::string nowhere = "memq://";
constexpr double longest_wait_s = 60.0;  // on an emulated CPU beside other tests

std::vector<std::string> gazed_with(std::vector<std::string> options) {
  std::vector<std::string> arguments{GAZED_PROGRAM, "--lcm-url", nowhere};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return arguments;
}

TEST(Daemon, LocatesTheReportsTestsWithinTwoSigmas) {
  const ProgramResult result = run_program(gazed_with({"--fixations", "2", "--print", "json"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto points = points_in(result.out);
  ASSERT_EQ(points.size(), 2U);
  for (const Json& point : points) {
    EXPECT_EQ(point["status"], "LOCATED") << point;
    EXPECT_EQ(point["views"], 2);
    EXPECT_LT(sigmas_off(point), 2.0) << point;
  }
  // Test 1 is seen in the image's centre, test 2 in a corner.
  EXPECT_NEAR(points[0]["pixel_1"][0].get<double>(), 319.5, 32.0);
  EXPECT_GT(std::abs(points[1]["pixel_1"][0].get<double>() - 319.5), 120.0);
}

TEST(Daemon, TheSameSeedGivesTheSamePoints) {
  constexpr std::size_t fixations = test::trials(2, 1);
  const auto arguments =
      gazed_with({"--fixations", std::to_string(fixations), "--print", "json", "--seed", "7"});
  const auto a = points_in(run_program(arguments).out), b = points_in(run_program(arguments).out);
  ASSERT_EQ(a.size(), fixations);
  ASSERT_EQ(b.size(), fixations);
  for (std::size_t i = 0; i < fixations; ++i) EXPECT_EQ(a[i]["range_m"], b[i]["range_m"]);
}

TEST(Daemon, ARecordingPlayedBackGivesTheSamePoints) {
  const std::string log = temporary_file("recording.lcm");
  constexpr std::size_t fixations = test::trials(4, 2);
  const auto live = run_program(
      gazed_with({"--fixations", std::to_string(fixations), "--print", "json", "--record", log}));
  ASSERT_EQ(live.exit_code, 0) << live.err;
  // The recording knows what the robot was believed to be worth.
  const auto replay = run_program(
      gazed_with({"--camera", "log:" + log, "--head", "log:" + log, "--print", "json"}));
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  const auto expected = points_in(live.out), found = points_in(replay.out);
  ASSERT_EQ(expected.size(), fixations);
  ASSERT_EQ(found.size(), fixations) << replay.err;
  constexpr double tolerance = 1e-9;  // agent/README.md, the rule on located points
  for (std::size_t i = 0; i < fixations; ++i) {
    EXPECT_EQ(expected[i]["status"], found[i]["status"]);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(expected[i]["position_m"][axis].get<double>(),
                  found[i]["position_m"][axis].get<double>(), tolerance);
    }
    EXPECT_NEAR(expected[i]["range_sigma_m"].get<double>(), found[i]["range_sigma_m"].get<double>(),
                tolerance);
  }
}

TEST(Daemon, ASignalEndsItCleanly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningProgram running(gazed_with({}));
    EXPECT_TRUE(running.prints("fixation", longest_wait_s));
    running.send_signal(signal);
    const ProgramResult result = running.finish();
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

TEST(Daemon, ASecondOneOnADeviceIsRefusedWithTheHoldersPid) {
  const std::string device = temporary_file("camera");
  const drivers::ExclusiveUse holder(device);
  const ProgramResult result = run_program(gazed_with({"--camera", "v4l2:" + device}));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr(device + " is used by process " + std::to_string(getpid()) + ","));
}

TEST(Daemon, WithoutACameraItSaysSoAndGoesOn) {
  const std::string device = temporary_file("no_camera", "no camera");
  RunningProgram running(gazed_with({"--camera", "v4l2:" + device}));
  EXPECT_TRUE(running.prints("gazed: " + device + ": not a video device", longest_wait_s));
  running.send_signal(SIGTERM);
  EXPECT_EQ(running.finish().exit_code, 0);
}

TEST(Daemon, PrintsWhatAPersonWantsToRead) {
  const ProgramResult result = run_program(gazed_with({"--fixations", "2"}));
  EXPECT_THAT(result.out, HasSubstr("LOCATED"));
  EXPECT_THAT(result.out, HasSubstr("m away"));
  EXPECT_THAT(result.out, HasSubstr("torso frame"));
  EXPECT_THAT(result.out, HasSubstr("2 fixations in"));
  EXPECT_THAT(result.out, HasSubstr("2 LOCATED"));
}

TEST(Daemon, BadArgumentsEndWithTwo) {
  const auto unknown = run_program(gazed_with({"--cammera", "sim"}));
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--cammera"));
  const auto robot = run_program(gazed_with({"--robot", "nao-v9"}));
  EXPECT_EQ(robot.exit_code, 2);
  EXPECT_THAT(robot.err, HasSubstr("nao-v9"));
  EXPECT_THAT(robot.err, HasSubstr("nao-v6"));
  const auto missing = run_program(gazed_with({"--config", "/nowhere/gazed.toml"}));
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("/nowhere/gazed.toml"));
}

TEST(Daemon, CheckReadsConfigurationAndSceneAndOpensNothing) {
  const std::string scene = temporary_file("wrong.toml", "[camera]\nfps = -1\n");
  const auto wrong = run_program(gazed_with({"--check", "--scene", scene}));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("wrong.toml:2"));
  EXPECT_THAT(wrong.err, HasSubstr("fps"));
  EXPECT_EQ(run_program(gazed_with({"--check"})).exit_code, 0);
}

TEST(Daemon, ALogThatEndsTooEarlyIsAFault) {
  const std::string log = temporary_file("short.lcm");
  ASSERT_EQ(
      run_program(gazed_with({"--fixations", "1", "--print", "none", "--record", log})).exit_code,
      0);
  const std::vector<std::string> replay{"--camera",   "log:" + log, "--head",
                                        "log:" + log, "--print",    "none"};
  auto too_many = replay;
  too_many.insert(too_many.end(), {"--fixations", "5"});
  EXPECT_EQ(run_program(gazed_with(too_many)).exit_code, 1);
  EXPECT_EQ(run_program(gazed_with(replay)).exit_code, 0);
}

}  // namespace
}  // namespace gazed::integration
