#include "agent/base/strict_toml.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <random>
#include <stdexcept>
#include <string>

namespace gazed::base::strict_toml_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Optional;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr std::size_t most_bytes = 1000;
constexpr Range range{-10.0, 10.0};

/// What reading a 2x3 matrix `m` and a number `n` throws; empty when it does not.
std::string complaint(const std::string& toml_text) {
  try {
    TomlDocument document(toml_text, "a.toml", most_bytes);
    StrictTable root(document);
    static_cast<void>(root.matrix<2, 3>("m", range));
    static_cast<void>(root.number("n", range));
    root.finish();
    document.check();
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(StrictToml, ReadsAMatrixRowByRow) {
  TomlDocument document("m = [[1, 2.5, 3], [4, 5, -6]]", "a.toml", most_bytes);
  StrictTable root(document);
  EXPECT_THAT((root.matrix<2, 3>("m", range)), Optional(ElementsAre(1, 2.5, 3, 4, 5, -6)));
  EXPECT_FALSE((root.matrix<2, 3>("absent", range)));
}

TEST(StrictToml, AnotherShapeIsNoMatrix) {
  for (const char* value :
       {"1", "[]", "[1, 2, 3, 4, 5, 6]", "[[1, 2, 3]]", "[[1, 2], [3, 4], [5, 6]]",
        "[[1, 2, 3], [4, 5]]", "[[1, 2, 3], [4, 5, '6']]", "[[1, 2, 3], [4, 5, nan]]",
        "[[1, 2, 3], [4, 5, 11]]"}) {
    EXPECT_THAT(complaint(std::string("\nm = ") + value), StartsWith("a.toml:2: m: ")) << value;
    EXPECT_THAT(complaint(std::string("m = ") + value),
                HasSubstr("found; allowed: 2 rows, [[...], ...], each of 3 numbers, -10 to 10"))
        << value;
  }
}

TEST(StrictToml, UnknownKeyNamesTheNearestKnown) {
  EXPECT_EQ(complaint("nn = 1"),
            "a.toml:1: nn: unknown key; the nearest known is n; allowed: m, n\n"
            "    1:1 | nn = 1\n"
            "        | ^^");
}

TEST(StrictToml, AllThatIsWrongIsSaidInTheOrderOfTheFile) {
  EXPECT_EQ(complaint("z = 1  # a comment\n"
                      "m = [[1, 2],\n"
                      "     [3, 4]]\n"
                      "n = '5'\n"),
            "a.toml:1: z: unknown key; the nearest known is m; allowed: m, n\n"
            "    1:1 | z = 1  # a comment\n"
            "        | ^\n"
            "a.toml:2: m: [ [ 1, 2 ], [ 3, 4 ] ] found; allowed: 2 rows, [[...], ...], each of 3 "
            "numbers, -10 to 10\n"
            "    2:5 | m = [[1, 2],\n"
            "        |     ^^^^^^^^\n"
            "a.toml:4: n: '5' found; allowed: a number, -10 to 10\n"
            "    4:5 | n = '5'\n"
            "        |     ^^^");
}

TEST(StrictToml, OfAKeyTheFirstErrorCounts) {
  TomlDocument document("n = 11\n", "a.toml", most_bytes);
  StrictTable root(document);
  EXPECT_FALSE(root.number("n", range));
  root.fail("n", "something else");
  EXPECT_THAT([&] { document.check(); },
              ThrowsMessage<std::invalid_argument>(
                  StartsWith("a.toml:1: n: 11 found; allowed: a number, -10 to 10\n")));
}

TEST(StrictToml, WhatIsMissingIsSaidLast) {
  TomlDocument document("n = 11\n", "a.toml", most_bytes);
  StrictTable root(document);
  root.fail("m", "a matrix");
  static_cast<void>(root.number("n", range));
  EXPECT_THAT(
      [&] { document.check(); },
      ThrowsMessage<std::invalid_argument>(AllOf(
          StartsWith("a.toml:1: n: "), EndsWith("\na.toml: m: nothing found; allowed: a matrix"))));
}

TEST(StrictToml, OfVeryManyErrorsAHundredAreShown) {
  std::string text;
  for (int i = 0; i < 104; ++i) text += "z" + std::to_string(i) + "=1\n";
  const std::string message = complaint(text);
  EXPECT_THAT(message, HasSubstr("a.toml:100: z99: unknown key"));
  EXPECT_THAT(message, Not(HasSubstr("a.toml:101: ")));
  EXPECT_THAT(message, EndsWith("\na.toml: 4 more of this kind"));
}

TEST(StrictToml, WhatIsNoTomlIsNamedWithItsLine) {
  EXPECT_THAT(complaint("n = 1\nn = 2"), StartsWith("a.toml:2: not TOML: "));
  EXPECT_THAT(complaint("\n\xc3\xa4 = 1"), StartsWith("a.toml:2: not TOML: "));
  EXPECT_EQ(complaint(std::string(most_bytes + 1, ' ')), "a.toml: longer than 1000 bytes");
}

TEST(StrictToml, AnyBytesAreReadOrRefused) {
  std::mt19937_64 random(1);
  constexpr std::string_view alphabet = "nm=[]1.5e-, \n\"'#\\{}";
  for (int trial = 0; trial < 5000; ++trial) {
    std::string text = "m = [[1, 2, 3], [4, 5, 6]]\nn = 1\n";
    for (std::size_t changes = random() % 6; changes > 0; --changes) {
      const bool any_byte = random() % 4 == 0;
      text[random() % text.size()] =
          any_byte ? static_cast<char>(random()) : alphabet[random() % alphabet.size()];
    }
    const std::string message = complaint(text);
    if (message.empty()) continue;
    EXPECT_THAT(message, StartsWith("a.toml:")) << text;
  }
}

}  // namespace
}  // namespace gazed::base::strict_toml_test
