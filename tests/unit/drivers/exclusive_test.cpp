#include "drivers/exclusive.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace gazed::drivers::exclusive_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Exclusive : public testing::Test {
 protected:
  Exclusive() { fs::create_directories(folder_); }
  ~Exclusive() override { fs::remove_all(folder_); }

  /// Why it cannot be had; empty when it can.
  std::string refusal(const std::string& resource) {
    try {
      const ExclusiveUse use(resource, {folder_});
      return use.warning();
    } catch (const InUse& error) {
      return error.what();
    }
  }

  /// Where the locks are.
  [[nodiscard]] std::string own_folder() const {
    const std::string own = folder_ + "/gazed-" + std::to_string(geteuid());
    fs::create_directories(own);
    fs::permissions(own, fs::perms::owner_all);
    return own;
  }

  std::string folder_ = testing::TempDir() + "/exclusive_test." + std::to_string(getpid());
};

TEST_F(Exclusive, TheSecondIsRefusedWithTheHoldersPid) {
  std::optional<ExclusiveUse> first(std::in_place, "/dev/video7", std::vector{folder_});
  EXPECT_THAT(refusal("/dev/video7"), HasSubstr("/dev/video7 is used by process " +
                                                std::to_string(getpid()) + ", another gazed"));
  EXPECT_EQ(refusal("/dev/video8"), "");
  first.reset();
  EXPECT_EQ(refusal("/dev/video7"), "");
}

TEST_F(Exclusive, TheLockMovesWithTheObject) {
  ExclusiveUse first("/dev/video7", {folder_});
  const ExclusiveUse moved = std::move(first);
  EXPECT_NE(refusal("/dev/video7"), "");
}

TEST_F(Exclusive, ALinkIsWhatItLeadsTo) {
  const std::string device = folder_ + "/video0", link = folder_ + "/video-top";
  std::ofstream(device) << "";
  fs::create_symlink(device, link);
  const ExclusiveUse first(link, {folder_});
  EXPECT_NE(refusal(device), "");
}

TEST_F(Exclusive, ALinkThatComesLaterIsTheSameStill) {
  const std::string device = folder_ + "/video0", link = folder_ + "/video-top";
  const ExclusiveUse first(link, {folder_});
  std::ofstream(device) << "";
  fs::create_symlink(device, link);
  EXPECT_NE(refusal(link), "");
}

TEST_F(Exclusive, AnothersFileUnderTheLocksNameIsNotEmptied) {
  const std::string victim = folder_ + "/victim";
  std::ofstream(victim) << "precious";
  fs::create_hard_link(victim, own_folder() + "/lock-dev-video7");
  EXPECT_THAT(refusal("/dev/video7"), HasSubstr("would not be noticed"));
  EXPECT_EQ(fs::file_size(victim), 8U);
}

// What others can open they can lock: no gazed could start.
TEST_F(Exclusive, NobodyElseCanOpenTheLock) {
  const ExclusiveUse first("/dev/video7", {folder_});
  const fs::path own = folder_ + "/gazed-" + std::to_string(geteuid());
  ASSERT_TRUE(fs::exists(own / "lock-dev-video7"));
  EXPECT_EQ(fs::status(own).permissions(), fs::perms::owner_all);
}

TEST_F(Exclusive, AFolderThatOthersCanOpenOrThatIsALinkIsNotUsed) {
  const std::string own = own_folder();
  fs::permissions(own, fs::perms::all);
  EXPECT_THAT(refusal("/dev/video7"), HasSubstr("would not be noticed"));
  EXPECT_TRUE(fs::is_empty(own));
  fs::remove(own);
  fs::create_directories(folder_ + "/elsewhere");
  fs::permissions(folder_ + "/elsewhere", fs::perms::owner_all);
  fs::create_symlink(folder_ + "/elsewhere", own);
  EXPECT_THAT(refusal("/dev/video7"), HasSubstr("would not be noticed"));
  EXPECT_TRUE(fs::is_empty(folder_ + "/elsewhere"));
}

TEST_F(Exclusive, AHolderThatIsKilledHoldsNothing) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const ExclusiveUse use("/dev/video7", {folder_});
    static_cast<void>(!write(ready[1], "x", 1));
    while (true) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THAT(refusal("/dev/video7"), HasSubstr("process " + std::to_string(child) + ","));
  kill(child, SIGKILL);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  close(ready[0]);
  close(ready[1]);
  EXPECT_EQ(refusal("/dev/video7"), "");
}

TEST_F(Exclusive, WhereNoFileCanBeMadeTheNextFolderServes) {
  const std::string not_there = folder_ + "/nothing";
  const ExclusiveUse first("/dev/video7", {not_there, folder_});
  EXPECT_EQ(first.warning(), "");
  EXPECT_NE(refusal("/dev/video7"), "");
  const ExclusiveUse nowhere("/dev/video7", {not_there});
  EXPECT_THAT(nowhere.warning(), HasSubstr("a second gazed on /dev/video7 would not be noticed"));
  EXPECT_THAT(nowhere.warning(), HasSubstr("No such file or directory"));
}

TEST_F(Exclusive, ALinkInPlaceOfTheFileIsNotFollowed) {
  const std::string victim = folder_ + "/victim";
  std::ofstream(victim) << "precious";
  fs::create_symlink(victim, own_folder() + "/lock-dev-video7");
  EXPECT_NE(refusal("/dev/video7"), "");
  EXPECT_EQ(fs::file_size(victim), 8U);
}

TEST_F(Exclusive, WhatAnotherWroteIsNoPid) {
  const std::string file = own_folder() + "/lock-dev-video7";
  std::ofstream(file) << "no number\n";
  EXPECT_EQ(refusal("/dev/video7"), "");
  // Longer than before, and not the rest of it.
  std::ofstream(file) << "123456789012345678901234567890";
  const ExclusiveUse first("/dev/video7", {folder_});
  EXPECT_THAT(refusal("/dev/video7"), HasSubstr("process " + std::to_string(getpid()) + ","));
}

TEST_F(Exclusive, LongAndStrangeNamesAreNames) {
  for (const std::string& name :
       {std::string("@abstract socket/\n\xff"), std::string(1000, 'x'), std::string()}) {
    const ExclusiveUse first(name, {folder_});
    EXPECT_EQ(first.warning(), "");
    EXPECT_NE(refusal(name), "");
  }
}

}  // namespace
}  // namespace gazed::drivers::exclusive_test
