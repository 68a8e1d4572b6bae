#include "drivers/log/older_logs.hpp"

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace gazed::log::older_logs_test {
namespace {

namespace fs = std::filesystem;

class OlderLogs : public testing::Test {
 protected:
  OlderLogs() { fs::create_directories(folder_); }
  ~OlderLogs() override { fs::remove_all(folder_); }

  void write(const std::string& name, std::size_t bytes) {
    std::ofstream(folder_ / name) << std::string(bytes, 'x');
  }
  /// 0 where there is none.
  [[nodiscard]] std::uintmax_t size(const std::string& name) const {
    return fs::exists(folder_ / name) ? fs::file_size(folder_ / name) : 0;
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("older_logs_test." + std::to_string(getpid()));
  const std::string log_ = folder_ / "walk.lcm";
};

TEST_F(OlderLogs, NoneIsLostHoweverOftenGazedStarts) {
  for (std::size_t run = 1; run <= 12; ++run) {
    write("walk.lcm", run);
    EXPECT_EQ(keep_as_older(log_), 0);
  }
  EXPECT_FALSE(fs::exists(log_));
  for (std::size_t run = 1; run <= 12; ++run)
    EXPECT_EQ(size("walk.lcm." + std::to_string(13 - run)), run);
}

TEST_F(OlderLogs, AGapIsFilledAndWhatLiesBehindItStays) {
  write("walk.lcm", 1);
  write("walk.lcm.1", 2);
  write("walk.lcm.3", 3);
  EXPECT_EQ(keep_as_older(log_), 0);
  EXPECT_EQ(size("walk.lcm.1"), 1U);
  EXPECT_EQ(size("walk.lcm.2"), 2U);
  EXPECT_EQ(size("walk.lcm.3"), 3U);
}

TEST_F(OlderLogs, TheOldestGoFirstAndOnlyBeyondTheBytesAllowed) {
  write("walk.lcm", 100);
  for (const char* older : {"walk.lcm.1", "walk.lcm.2", "walk.lcm.3"}) write(older, 100);
  remove_oldest(log_, 100, 400.0);
  EXPECT_EQ(size("walk.lcm.3"), 100U);
  remove_oldest(log_, 100, 399.0);
  EXPECT_EQ(size("walk.lcm.3"), 0U);
  EXPECT_EQ(size("walk.lcm.2"), 100U);
  remove_oldest(log_, 500, 399.0);
  EXPECT_EQ(size("walk.lcm.1"), 0U);
  EXPECT_EQ(size("walk.lcm"), 100U) << "the one that is written is never removed";
}

TEST_F(OlderLogs, WhatCannotBeRenamedIsTold) {
  EXPECT_EQ(keep_as_older(folder_ / "nothing.lcm"), ENOENT);
}

}  // namespace
}  // namespace gazed::log::older_logs_test
