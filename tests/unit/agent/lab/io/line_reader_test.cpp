#include "agent/lab/io/line_reader.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/agent/lab/scratch.hpp"

namespace gazed::lab::io::line_reader_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

std::vector<std::string> lines_of(const std::string& text) {
  const ScratchFolder folder;
  write_text(folder / "a.txt", text);
  LineReader reader(folder / "a.txt");
  std::vector<std::string> lines;
  while (reader.next()) {
    lines.push_back(reader.line());
    EXPECT_EQ(reader.number(), lines.size());
  }
  EXPECT_EQ(reader.bytes_read(), text.size());
  EXPECT_EQ(reader.bytes_in_all(), text.size());
  return lines;
}

TEST(LineReader, TakesLineEndsOfEverySystem) {
  EXPECT_THAT(lines_of("a\nb\r\n\nc"), ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(lines_of("a\n"), ElementsAre("a"));
  EXPECT_THAT(lines_of(""), IsEmpty());
}

TEST(LineReader, DropsAByteOrderMark) {
  EXPECT_THAT(lines_of("\xEF\xBB\xBF"
                       "a\n\xEF\xBB\xBF"
                       "b"),
              ElementsAre("a",
                          "\xEF\xBB\xBF"
                          "b"));
}

TEST(LineReader, KeepsZeroBytes) {
  EXPECT_THAT(lines_of(std::string("a\0b\n", 4)), ElementsAre(std::string("a\0b", 3)));
}

TEST(LineReader, LongestLine) {
  const std::string longest(LineReader::longest_line, 'x');
  EXPECT_THAT(lines_of("a\n" + longest + "\n"), ElementsAre("a", longest));
  EXPECT_THAT(
      [&] { static_cast<void>(lines_of("a\nx" + longest)); },
      ThrowsMessage<std::runtime_error>(HasSubstr("a.txt:2: the line is longer than 65536 bytes")));
}

TEST(LineReader, FileThatCannotBeReadIsNamed) {
  EXPECT_THAT([] { const LineReader reader("/nowhere/a.txt"); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("/nowhere/a.txt: cannot be opened: No such file")));
  const ScratchFolder folder;
  EXPECT_THAT(
      [&] {
        LineReader reader(folder.path());
        static_cast<void>(reader.next());
      },
      ThrowsMessage<std::runtime_error>(
          AllOf(HasSubstr(folder.path().string()), HasSubstr("cannot be read: Is a directory"))));
}

}  // namespace
}  // namespace gazed::lab::io::line_reader_test
