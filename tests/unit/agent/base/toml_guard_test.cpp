#include "agent/base/toml_guard.hpp"

#include <gmock/gmock.h>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/sim/scene.hpp"

namespace gazed::base::toml_guard_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TomlGuard, LettersOutsideAsciiBelongInStringsAndComments) {
  EXPECT_FALSE(toml_hazard("# caf\xc3\xa9\na = \"caf\xc3\xa9\" # \xc3\xa9\nb = 'caf\xc3\xa9'\n"));
  EXPECT_FALSE(
      toml_hazard("\xEF\xBB\xBF"
                  "a = 1\n"));
  EXPECT_FALSE(toml_hazard("a = \"quote \\\" and caf\xc3\xa9\"\n"));
  EXPECT_EQ(toml_hazard("a = 1\nb = \xc3\xa9\n")->line, 2U);
  EXPECT_TRUE(toml_hazard("a = \"x\" \xc3\xa9\n"));
  EXPECT_TRUE(
      toml_hazard("\xc2\xa0"
                  "a = 1\n"));
  EXPECT_TRUE(toml_hazard("a = \"\"\"\\\n\xc3\xa9\"\"\"\n"));
  EXPECT_TRUE(toml_hazard("a = \"\\\xc3\xa9\"\n"));
  EXPECT_TRUE(toml_hazard("a = 'back\\' \xc3\xa9\n"));
}

/// toml++ looks for a number's end without heeding quotes.
TEST(TomlGuard, NumbersGoOnOverQuotes) {
  for (const char* number : {"1", "+", "-", "0x", "1.5", "1979-05-27", "1979-05-27 "}) {
    EXPECT_TRUE(toml_hazard(std::string("a = ") + number + "\"\xc3\xa9\"\n")) << number;
    EXPECT_TRUE(toml_hazard(std::string("a = [") + number + "'\xc3\xa9']\n")) << number;
  }
  EXPECT_FALSE(toml_hazard("a = [1, \"\xc3\xa9\", 2, '\xc3\xa9']\nb = {c = 1}#\xc3\xa9\n"));
  EXPECT_FALSE(toml_hazard("a = 1 # \xc3\xa9\nb = 1979-05-27 # \xc3\xa9\n"));
}

/// Were each number of it looked through to the end, this would not end either.
TEST(TomlGuard, NumbersInANumberAreLookedThroughOnce) {
  std::string text = "a = ";
  for (int i = 0; i < 2'000'000; ++i) text += "1(";
  EXPECT_FALSE(toml_hazard(text));
  EXPECT_TRUE(toml_hazard(text + "\"\xc3\xa9\""));
}

TEST(TomlGuard, DecimalsAreNoDottedNames) {
  std::string numbers, names, digits;
  for (int i = 0; i < 5000; ++i) {
    numbers += "a = [ 1.5, -0.25e3 ]\n";
    names += ".a";
    digits += ".1";
  }
  EXPECT_FALSE(toml_hazard(numbers));
  EXPECT_TRUE(toml_hazard("a" + names));
  EXPECT_TRUE(toml_hazard("1" + digits));
  EXPECT_FALSE(toml_hazard(sim::default_scene_toml()));
}

/// "line:column" of each string that nothing ends.
std::vector<std::string> unclosed(std::string_view text) {
  std::vector<std::string> places;
  for (const UnclosedString& string : unclosed_strings(text)) {
    places.push_back(std::to_string(string.begin.line) + ':' + std::to_string(string.begin.column));
  }
  return places;
}

TEST(TomlGuard, StringsWithoutAnEnd) {
  EXPECT_THAT(unclosed("a = \"b\"\nc = 'd' # it's\ne = \"\"\"f\n\"g\n\"\"\"\"\"\nh = ''\n"),
              IsEmpty());
  EXPECT_THAT(unclosed("a = \"b\\\"\nc = 'd\\'\n"), ElementsAre("1:5"));
  EXPECT_THAT(unclosed("a = 1\nb = 'c\nd = ['e', f']"), ElementsAre("2:5", "3:12"));
  EXPECT_THAT(unclosed("a = 'caf\xc3\xa9' + 'b"), ElementsAre("1:14"));
  EXPECT_THAT(unclosed("a = 1\n  b = '''c\n'd'\n"), ElementsAre("2:7"));
}

}  // namespace
}  // namespace gazed::base::toml_guard_test
