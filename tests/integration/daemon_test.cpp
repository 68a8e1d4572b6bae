// gazed as a user runs it.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

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
    EXPECT_GE(point["views"], 3);
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
  auto a = points_in(run_program(arguments).out), b = points_in(run_program(arguments).out);
  ASSERT_EQ(a.size(), fixations);
  ASSERT_EQ(b.size(), fixations);
  for (std::size_t i = 0; i < fixations; ++i) {
    for (Json* point : {&a[i], &b[i]}) point->erase("utime");  // simulated time begins now
    EXPECT_EQ(a[i], b[i]);
  }
}

/// All that was published, by channel and in order, as bytes.
using Published = std::map<std::string, std::vector<std::string>>;

Published published_in(const std::string& log_file) {
  Published published;
  ::lcm::LogFile log(log_file, "r");
  EXPECT_TRUE(log.good()) << log_file;
  while (const ::lcm::LogEvent* event = log.good() ? log.readNextEvent() : nullptr) {
    published[event->channel].emplace_back(static_cast<const char*>(event->data),
                                           static_cast<std::size_t>(event->datalen));
  }
  return published;
}

/// The same bytes, whatever the messages' fields are; on a difference, which and where.
void expect_same(const std::vector<std::string>& expected, const std::vector<std::string>& found,
                 const std::string& channel) {
  EXPECT_EQ(expected.size(), found.size()) << channel;
  for (std::size_t i = 0; i < std::min(expected.size(), found.size()); ++i) {
    const auto [a, b] =
        std::mismatch(expected[i].begin(), expected[i].end(), found[i].begin(), found[i].end());
    EXPECT_TRUE(a == expected[i].end() && b == found[i].end())
        << channel << ", message " << i << " of " << expected.size() << ", from byte "
        << a - expected[i].begin() << " of " << expected[i].size();
  }
}

/// A run's points, maps, commands, head states and images.
ProgramResult run_published(std::vector<std::string> options, const std::string& name,
                            Published& published) {
  const std::string log = temporary_file(name),
                    config = temporary_file("images.toml", "[publish]\nimages = true\n");
  options.insert(options.begin(), {GAZED_PROGRAM, "--lcm-url", "file://" + log + "?mode=w",
                                   "--config", config, "--print", "json"});
  const ProgramResult result = run_program(options);
  published = published_in(log);
  return result;
}

TEST(Daemon, ARecordingPlayedBackIsPublishedBitForBit) {
  const std::string log = temporary_file("recording.lcm");
  constexpr std::size_t fixations = test::trials(4, 2);
  Published expected, found;
  const auto live = run_published({"--fixations", std::to_string(fixations), "--record", log},
                                  "live.lcm", expected);
  ASSERT_EQ(live.exit_code, 0) << live.err;
  // The recording knows what the robot was believed to be worth.
  const auto replay =
      run_published({"--camera", "log:" + log, "--head", "log:" + log}, "replay.lcm", found);
  ASSERT_EQ(replay.exit_code, 0) << replay.err;
  ASSERT_EQ(expected["GAZED_LOCATED_POINT"].size(), fixations);
  EXPECT_EQ(live.out, replay.out);
  // A status tells of the process: its time of the clock, its share of the processor.
  // A recorded head is not sent on the detours that the play of gears asks for, nor back.
  for (Published* published : {&expected, &found}) {
    EXPECT_EQ(published->erase("GAZED_STATUS"), 1U);
    EXPECT_EQ(published->erase("GAZED_HEAD_COMMAND"), 1U);
  }
  for (const auto& [channel, messages] : expected) expect_same(messages, found[channel], channel);
  EXPECT_THAT(found, ::testing::UnorderedElementsAre(
                         ::testing::Key("GAZED_FIXATION"), ::testing::Key("GAZED_HEAD_STATE"),
                         ::testing::Key("GAZED_IMAGE"), ::testing::Key("GAZED_LOCATED_POINT"),
                         ::testing::Key("GAZED_SALIENCY")));
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

// Opened as a file is, a FIFO is waited at for ever, by whom no signal reaches any more.
TEST(Daemon, AFifoIsRefusedAtOnceWhereverAFileIsNamed) {
  const std::string fifo = temporary_file("fifo");
  std::filesystem::remove(fifo);
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--record", fifo},
        {"--camera", "log:" + fifo, "--head", "log:" + fifo},
        {"--config", fifo},
        {"--scene", fifo}}) {
    const auto result = run_program(gazed_with(options));
    EXPECT_EQ(result.exit_code, 2) << options.front();
    EXPECT_THAT(result.err, HasSubstr("a FIFO; a regular file is needed")) << options.front();
  }
  std::filesystem::remove(fifo);
}

TEST(Daemon, CheckReadsConfigurationAndSceneAndOpensNothing) {
  const std::string scene = temporary_file("wrong.toml", "[camera]\nfps = -1\n");
  const auto wrong = run_program(gazed_with({"--check", "--scene", scene}));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("wrong.toml:2"));
  EXPECT_THAT(wrong.err, HasSubstr("fps"));
  EXPECT_EQ(run_program(gazed_with({"--check"})).exit_code, 0);
}

// Where nothing that comes fits, no fixation ever ends.
TEST(Daemon, ACameraOfAnotherSizeThanTheScenesIsRefused) {
  const auto result = run_program(gazed_with(
      {"--fixations", "1", "--set", "camera.width_px=320", "--set", "camera.height_px=240"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("320x240 found; allowed: 640x480"));
}

TEST(Daemon, CheckSaysWhatItCheckedAndWhatCanHardlyBeMeant) {
  const auto result =
      run_program(gazed_with({"--check", "--set", "camera.mount_rotation_rad=[0.0, 1.2, 0.0]"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("checked: no configuration file, robot nao-v6"));
  EXPECT_THAT(result.err, HasSubstr("camera.mount_rotation_rad: [0.0, 1.2, 0.0] can hardly be"));
}

TEST(Daemon, OutputThatIsLostIsNoSuccess) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--fixations", "1"},
                                                  {"--help"},
                                                  {"--version"},
                                                  {"--print-config"},
                                                  {"--check"}}) {
    const auto result = run_without_room_for_output(gazed_with(options));
    EXPECT_EQ(result.exit_code, 1) << options.front();
    EXPECT_THAT(result.err, HasSubstr("No space left on device")) << options.front();
  }
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
