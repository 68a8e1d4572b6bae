#include "drivers/log/log_writer.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <utility>

#include "drivers/log/log_camera.hpp"

#include "log_files.hpp"
#include "tests/unit/drivers/lcm/messages.hpp"

namespace gazed::log::log_writer_test {
namespace {

using lcm::frame_us;
using lcm::start_us;
using ::testing::HasSubstr;

const lcm::Channels channels("GAZED");

// The largest size of a file that this process may write, until the end of the test.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(LogWriter, FolderThatIsNotThere) {
  try {
    LogWriter("/nowhere/robot.lcm", channels);
    FAIL() << "opened";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "cannot write the log /nowhere/robot.lcm: No such file or directory");
  }
}

TEST(LogWriter, AnEventThatDoesNotFitEndsAWholeLog) {
  const TemporaryFile file;
  const base::Image image = lcm::test_image(8, 4, base::PixelFormat::yuyv);
  LogWriter writer(file.path(), channels);
  EXPECT_TRUE(writer.write(geometry::Frame{image.view(), start_us}));
  EXPECT_EQ(writer.fault(), "");
  const std::size_t one_event = file.read().size();
  {
    const FileSizeLimit limit(one_event + 50);  // in the middle of the second
    EXPECT_FALSE(writer.write(geometry::Frame{image.view(), start_us + frame_us}));
    EXPECT_THAT(writer.fault(), HasSubstr("has stopped: File too large; it holds 1 event"));
    EXPECT_EQ(file.read().size(), one_event) << "the part that was written is cut off";
  }
  EXPECT_FALSE(writer.write(geometry::Frame{image.view(), start_us + 2 * frame_us}))
      << "there is room again, but a recording with a hole is none";
  EXPECT_THAT(writer.fault(), HasSubstr("it holds 1 event"));

  LogCamera camera(file.path(), channels, 8, 4);
  EXPECT_EQ(camera.next_frame()->utime_us, start_us);
  EXPECT_TRUE(camera.finished());
  EXPECT_EQ(camera.notes(), "");
}

// A player of logs waits for as long as events lie apart, and must not go back.
TEST(LogWriter, AFixationAndItsPointAreKeptAtTheTimeOfTheEventBeforeThem) {
  const TemporaryFile file;
  const base::Image image = lcm::test_image(8, 4, base::PixelFormat::yuyv);
  fixation_t fixation{};
  fixation.utime = start_us;
  fixation.status_name = "LOCATED";
  located_point_t point{};
  point.utime = start_us;
  point.reason = "within the gate";
  {
    LogWriter writer(file.path(), channels);
    EXPECT_TRUE(writer.write(geometry::Frame{image.view(), start_us}));
    EXPECT_TRUE(writer.write(lcm::head_state(start_us + 7)));
    EXPECT_TRUE(writer.write(point));
    EXPECT_TRUE(writer.write(fixation));
  }
  ::lcm::LogFile log(file.path(), "r");
  ASSERT_TRUE(log.good());
  for (const char* channel : {"GAZED_IMAGE", "GAZED_HEAD_STATE"})
    EXPECT_EQ(log.readNextEvent()->channel, channel);
  const ::lcm::LogEvent* event = log.readNextEvent();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->channel, "GAZED_LOCATED_POINT");
  EXPECT_EQ(event->timestamp, start_us + 7);
  located_point_t read_point{};
  EXPECT_EQ(read_point.decode(event->data, 0, event->datalen), event->datalen);
  EXPECT_EQ(read_point.reason, "within the gate");
  event = log.readNextEvent();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->channel, "GAZED_FIXATION");
  EXPECT_EQ(event->timestamp, start_us + 7);
  fixation_t read{};
  EXPECT_EQ(read.decode(event->data, 0, event->datalen), event->datalen);
  EXPECT_EQ(read.utime, start_us);
  EXPECT_EQ(read.status_name, "LOCATED");

  LogCamera camera(file.path(), channels, 8, 4);
  EXPECT_EQ(camera.next_frame()->utime_us, start_us);
  EXPECT_TRUE(camera.finished());
  EXPECT_EQ(camera.notes(), "");
}

TEST(LogWriter, AnOldLogIsKeptBesideTheNewOne) {
  const std::string path = testing::TempDir() + "/log_writer_test.lcm", old = path + ".1";
  std::ofstream(path) << std::string(100'000, 'x');
  LogWriter(path, channels).write(lcm::head_state(start_us));
  EXPECT_LT(std::filesystem::file_size(path), 200U);
  EXPECT_EQ(std::filesystem::file_size(old), 100'000U);
  std::filesystem::remove(path);
  std::filesystem::remove(old);
}

// Opened as other files are, it would wait for a reader for ever.
TEST(LogWriter, AFifoIsRefusedAtOnce) {
  const std::string fifo = ::testing::TempDir() + "fifo_of_writer";
  std::filesystem::remove(fifo);
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  try {
    LogWriter(fifo, lcm::Channels("GAZED"));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("a FIFO; a regular file is needed"));
  }
  std::filesystem::remove(fifo);
}

TEST(LogWriter, ADeviceAndAFolderAreRefused) {
  for (const auto& [path, kind] :
       {std::pair{"/dev/full", "a device"}, std::pair{"/tmp", "a folder"}}) {
    try {
      LogWriter(path, channels);
      FAIL() << "accepted " << path;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "cannot write the log " + std::string(path) + ": " + kind +
                                  "; a regular file is needed");
    }
  }
}

}  // namespace
}  // namespace gazed::log::log_writer_test
