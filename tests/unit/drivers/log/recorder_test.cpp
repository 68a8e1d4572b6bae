#include "drivers/log/recorder.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "drivers/log/log_head.hpp"
#include "drivers/log/log_reader.hpp"

#include "log_files.hpp"
#include "tests/unit/drivers/lcm/messages.hpp"

namespace gazed::log::recorder_test {
namespace {

using namespace std::chrono_literals;
using lcm::frame_us;
using lcm::start_us;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const lcm::Channels channels("GAZED");
constexpr auto patience = 60s;  // under an emulator, beside other work
constexpr int width_px = 640, height_px = 480;

/// Tries until it holds.
template <class Condition>
bool within_patience(Condition holds) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    poll(nullptr, 0, 2);
  }
  return true;
}

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() { fs::create_directories(folder_); }
  /// The process of a recorder that has ended may still write what is left.
  ~RecorderTest() override {
    EXPECT_TRUE(within_patience([&] {
      std::error_code error;
      fs::remove_all(folder_, error);
      return !fs::exists(folder_);
    }));
  }

  [[nodiscard]] RecorderSettings settings() const {
    return {.path = log_,
            .frame_bytes_max = std::size_t{3} * width_px * height_px,
            .configuration = "robot = \"nao-v6\"\n"};
  }
  [[nodiscard]] std::size_t count(const std::string& path, const std::string& channel) const {
    LogReader reader(path, channel);
    std::size_t messages = 0;
    while (reader.next_message()) ++messages;
    EXPECT_EQ(reader.notes(), "");
    return messages;
  }
  /// Head states, one a call, until the file holds one more.
  [[nodiscard]] bool goes_on(Recorder& recorder) {
    const auto size = [&] { return fs::exists(log_) ? fs::file_size(log_) : 0; };
    const auto before = size();
    return within_patience([&] {
      recorder.write(lcm::head_state(utime_us_ += 12'000));
      return size() > before;
    });
  }

  // Each test's own: a recorder's process may outlive its test.
  const fs::path folder_ = fs::path(testing::TempDir()) /
                           (std::string("recorder_test.") + std::to_string(getpid()) +
                            testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::string log_ = folder_ / "walk.lcm";
  const base::Image image_ = lcm::test_image(width_px, height_px, base::PixelFormat::yuyv);
  std::int64_t utime_us_ = start_us;
};

TEST_F(RecorderTest, WhatItWasGivenIsInTheFileWhenItHasFinished) {
  {
    Recorder recorder(settings(), channels);
    EXPECT_FALSE(fs::exists(log_)) << "nothing is touched before it begins";
    recorder.begin();
    recorder.write(geometry::Frame{image_.view(), start_us});
    recorder.write(lcm::head_state(start_us + 7));
    recorder.write(located_point_t{}, fixation_t{});
    recorder.finish(patience);
    EXPECT_EQ(recorder.fault(), "");
  }
  EXPECT_EQ(count(log_, channels.image), 1U);
  EXPECT_EQ(count(log_, channels.head_state), 1U);
  EXPECT_EQ(count(log_, channels.located_point), 1U);
  EXPECT_EQ(count(log_, channels.fixation), 1U);
  EXPECT_EQ(recorded_configuration(log_, channels), "robot = \"nao-v6\"\n");
  EXPECT_EQ(recorded_prefix(log_, "OTHER"), "GAZED");
  EXPECT_EQ(recorded_configuration(log_, std::string("OTHER")), "robot = \"nao-v6\"\n");
}

TEST_F(RecorderTest, WhatIsLeftAtTheEndIsWrittenBeforeAnybodyWaits) {
  constexpr std::size_t states = 100;
  Recorder recorder(settings(), channels);
  recorder.begin();
  for (std::size_t i = 0; i < states; ++i) recorder.write(lcm::head_state(utime_us_ += 12'000));
  const pid_t process = recorder.process();
  recorder.end();
  siginfo_t ended{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_EQ(count(log_, channels.head_state), states);
  recorder.write(lcm::head_state(utime_us_ += 12'000));  // too late: no process is started for it
  EXPECT_EQ(recorder.process(), process);
  recorder.finish(patience);
}

// A disk that stands still: the process does, as one that waits for it.
TEST_F(RecorderTest, WhileTheDiskStandsStillFramesAreDroppedAndHeadStatesKept) {
  constexpr std::size_t frames = 60, states = 166;  // two seconds
  Recorder recorder(settings(), channels);
  recorder.begin();
  ASSERT_TRUE(goes_on(recorder));
  kill(recorder.process(), SIGSTOP);
  const std::int64_t stopped_us = utime_us_;
  for (std::size_t i = 0; i < frames; ++i)
    recorder.write(geometry::Frame{image_.view(), utime_us_ += frame_us});
  EXPECT_FALSE(recorder.has_room());
  for (std::size_t i = 0; i < states; ++i) recorder.write(lcm::head_state(utime_us_ += 1));
  EXPECT_THAT(recorder.fault(), HasSubstr("walk.lcm lacks 54 events"));
  EXPECT_GT(utime_us_, stopped_us);
  kill(recorder.process(), SIGCONT);
  recorder.finish(patience);
  EXPECT_EQ(count(log_, channels.image), 6U);
  EXPECT_GE(count(log_, channels.head_state), states);
}

TEST_F(RecorderTest, OlderRecordingsAreKept) {
  for (int run = 0; run < 3; ++run) {
    Recorder recorder(settings(), channels);
    recorder.begin();
    for (int i = 0; i <= run; ++i) recorder.write(lcm::head_state(start_us + i));
    recorder.finish(patience);
  }
  EXPECT_EQ(count(log_, channels.head_state), 3U);
  EXPECT_EQ(count(log_ + ".1", channels.head_state), 2U);
  EXPECT_EQ(count(log_ + ".2", channels.head_state), 1U);
}

TEST_F(RecorderTest, TheOldestAreRemovedWhereNoMoreIsToBeKept) {
  std::ofstream(log_ + ".1") << std::string(2000, 'x');
  std::ofstream(log_ + ".2") << std::string(2000, 'x');
  RecorderSettings keeps = settings();
  keeps.keep_bytes = 3000;
  Recorder recorder(keeps, channels);
  recorder.begin();
  EXPECT_TRUE(within_patience([&] { return !fs::exists(log_ + ".2"); }));
  EXPECT_TRUE(fs::exists(log_ + ".1"));
}

TEST_F(RecorderTest, AFolderThatComesLaterIsRecordedTo) {
  fs::remove_all(folder_);
  Recorder recorder(settings(), channels);
  recorder.begin();
  ASSERT_TRUE(within_patience([&] { return !recorder.fault().empty(); }));
  EXPECT_EQ(recorder.fault(), "cannot write the log " + log_ + ": No such file or directory");
  fs::create_directories(folder_);
  EXPECT_TRUE(goes_on(recorder));
  EXPECT_TRUE(
      within_patience([&] { return recorder.fault().find("cannot") == std::string::npos; }));
}

TEST_F(RecorderTest, AFileThatIsRemovedIsToldAndMadeAnew) {
  Recorder recorder(settings(), channels);
  recorder.begin();
  ASSERT_TRUE(goes_on(recorder));
  fs::remove(log_);
  ASSERT_TRUE(goes_on(recorder));
  EXPECT_THAT(recorder.fault(),
              HasSubstr("walk.lcm was removed or renamed while it was written, and begun anew"));
  recorder.finish(patience);
  EXPECT_EQ(recorded_configuration(log_, channels), "robot = \"nao-v6\"\n");
}

TEST_F(RecorderTest, AFileThatAnotherWritesIsLeftAlone) {
  std::ofstream(log_) << "another's";
  const base::FileDescriptor another(open(log_.c_str(), O_RDWR | O_CLOEXEC));
  ASSERT_EQ(flock(another.get(), LOCK_EX), 0);
  Recorder recorder(settings(), channels);
  recorder.begin();
  ASSERT_TRUE(within_patience([&] { return !recorder.fault().empty(); }));
  EXPECT_EQ(recorder.fault(), "cannot write the log " + log_ + ": another process writes it");
  EXPECT_EQ(fs::file_size(log_), 9U);
  ASSERT_EQ(flock(another.get(), LOCK_UN), 0);
  ASSERT_TRUE(within_patience([&] { return fs::exists(log_ + ".1"); }));
}

TEST_F(RecorderTest, AProcessThatIsKilledIsStartedAgain) {
  Recorder recorder(settings(), channels);
  recorder.begin();
  ASSERT_TRUE(goes_on(recorder));
  const pid_t first = recorder.process();
  kill(first, SIGKILL);
  ASSERT_TRUE(within_patience([&] {
    recorder.write(lcm::head_state(utime_us_ += 12'000));
    return recorder.process() != first;
  }));
  EXPECT_THAT(recorder.fault(), HasSubstr("was ended, and started again"));
  ASSERT_TRUE(within_patience([&] { return fs::exists(log_ + ".1"); }));
  EXPECT_TRUE(goes_on(recorder));
}

// Whoever waits for room writes nothing that would tell that nobody makes any.
TEST_F(RecorderTest, AProcessThatIsKilledWhileItIsWaitedForIsStartedAgain) {
  Recorder recorder(settings(), channels);
  recorder.begin();
  ASSERT_TRUE(goes_on(recorder));
  kill(recorder.process(), SIGSTOP);
  while (recorder.has_room()) recorder.write(geometry::Frame{image_.view(), utime_us_ += frame_us});
  kill(recorder.process(), SIGKILL);
  EXPECT_TRUE(within_patience([&] { return recorder.has_room(); }));
}

TEST_F(RecorderTest, ADiskThatIsFullIsToldAndTriedAgain) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit limit = before;
  limit.rlim_cur = 2000;
  setrlimit(RLIMIT_FSIZE, &limit);  // of the recorder's process as well
  Recorder recorder(settings(), channels);
  setrlimit(RLIMIT_FSIZE, &before);
  recorder.begin();
  ASSERT_TRUE(within_patience([&] {
    recorder.write(lcm::head_state(utime_us_ += 12'000));
    return !recorder.fault().empty();
  }));
  EXPECT_THAT(recorder.fault(), HasSubstr("walk.lcm has stopped: File too large; it holds "));
  rlimit larger = before;
  ASSERT_EQ(prlimit(recorder.process(), RLIMIT_FSIZE, &larger, nullptr), 0);
  EXPECT_TRUE(goes_on(recorder));
  EXPECT_TRUE(
      within_patience([&] { return recorder.fault().find("has stopped") == std::string::npos; }));
  EXPECT_THAT(recorder.fault(), HasSubstr("walk.lcm lacks "));
  recorder.finish(patience);
  EXPECT_GT(count(log_, channels.head_state), 0U);
}

TEST_F(RecorderTest, WhatCanNeverBeRecordedToIsRefused) {
  const std::string fifo = folder_ / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& path : {fifo, std::string("/dev/full"), folder_.string()}) {
    RecorderSettings wrong = settings();
    wrong.path = path;
    EXPECT_THROW(Recorder(wrong, channels), std::invalid_argument) << path;
  }
}

}  // namespace
}  // namespace gazed::log::recorder_test
