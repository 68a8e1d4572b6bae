#include "agent/base/regular_file.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <sys/stat.h>

namespace gazed::base::regular_file_test {
namespace {

std::string refusal_of(const std::string& path) {
  try {
    static_cast<void>(read_text(path, 10));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "read";
}

TEST(RegularFile, IsReadAsFarAsWanted) {
  const std::string path = ::testing::TempDir() + "regular_file";
  std::ofstream(path) << "0123456789abc";
  EXPECT_EQ(read_text(path, 20), "0123456789abc");
  EXPECT_EQ(read_text(path, 10), "0123456789a") << "one byte more tells that it is longer";
  EXPECT_EQ(open_regular_file(path).bytes, 13);
  EXPECT_TRUE(std::filesystem::remove(path));
}

// Opened as regular files are, a FIFO would wait for a writer for ever, and /dev/zero never ends.
TEST(RegularFile, NothingElseIsOpened) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  const std::string fifo = ::testing::TempDir() + "fifo_of_regular_file";
  std::filesystem::remove(fifo);
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(refusal_of(fifo), fifo + ": cannot be read: a FIFO; a regular file is needed");
  EXPECT_EQ(refusal_of(folder), folder + ": cannot be read: a folder; a regular file is needed");
  EXPECT_EQ(refusal_of("/dev/zero"),
            "/dev/zero: cannot be read: a device; a regular file is needed");
  EXPECT_EQ(refusal_of("/nowhere/a.toml"),
            "/nowhere/a.toml: cannot be read: No such file or directory");
  EXPECT_LT(open_regular_file(fifo).descriptor.get(), 0);
  EXPECT_TRUE(std::filesystem::remove(fifo));
}

}  // namespace
}  // namespace gazed::base::regular_file_test
