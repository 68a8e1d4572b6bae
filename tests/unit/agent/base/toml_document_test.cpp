#include <gmock/gmock.h>
#include <stdexcept>
#include <string>
#include <variant>

#include "agent/base/toml.hpp"

namespace gazed::base::toml_document_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::size_t most_bytes = 65536;

/// What parsing says against a text.
std::string complaint(const std::string& text) {
  try {
    static_cast<void>(TomlDocument(text, "a.toml", most_bytes));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

/// "line:column+length".
std::string text_of(const TextPlace& place) {
  return std::to_string(place.line) + ':' + std::to_string(place.column) + '+' +
         std::to_string(place.length);
}

TEST(TomlDocument, KeysAndValuesAreInTheOrderOfTheTextWithTheirPlaces) {
  const TomlDocument document(
      "z = 1\n"
      "  a.b = [1, 2]  # two\n"
      "[table]\n"
      "m = [[1, 2],  # rows\n"
      "     [3, 4]]\n"
      "[[list]]\n"
      "s = \"caf\xc3\xa9\"\n",
      "a.toml", most_bytes);
  const TomlTable& root = document.root();
  ASSERT_EQ(root.size(), 4U);
  EXPECT_EQ(root[0].name, "z");
  EXPECT_EQ(text_of(root[0].name_place), "1:1+1");
  EXPECT_EQ(text_of(root[0].node.place), "1:5+1");
  EXPECT_EQ(root[1].name, "a");
  const auto& b = std::get<TomlTable>(root[1].node.value).front();
  EXPECT_EQ(text_of(b.name_place), "2:5+1");
  EXPECT_EQ(text_of(b.node.place), "2:9+6");
  EXPECT_EQ(text_of(root[2].node.place), "3:2+5");
  EXPECT_EQ(text_of(std::get<TomlTable>(root[2].node.value).front().node.place), "4:5+8");
  const auto& list = std::get<TomlArray>(root[3].node.value);
  EXPECT_EQ(text_of(root[3].node.place), "6:3+4");
  EXPECT_EQ(text_of(list.front().place), "6:1+8");
  EXPECT_EQ(text_of(std::get<TomlTable>(list.front().value).front().node.place), "7:5+6");
}

TEST(TomlDocument, ErrorsShowTheirLine) {
  EXPECT_EQ(complaint("a = 1\nb = 2 3\n"),
            "a.toml:2: not TOML: Error while parsing key-value pair: expected a comment or "
            "whitespace, saw '3'\n"
            "    2:7 | b = 2 3\n"
            "        |       ^");
  EXPECT_THAT(complaint("\tb 2\n"), EndsWith("\n    1:4 |  b 2\n"
                                             "        |    ^"));
}

TEST(TomlDocument, MissingQuoteIsNamed) {
  EXPECT_EQ(complaint("[run]\nprint  = \"text   # no end\nrecord = \"\"\n"),
            "a.toml:2: not TOML: the string that begins at a.toml:2:10 has no closing quote\n"
            "   2:10 | print  = \"text   # no end\n"
            "        |          ^");
  EXPECT_THAT(complaint("a = 'x"), HasSubstr("begins at a.toml:1:5 has no closing quote"));
  EXPECT_THAT(complaint("\na = \"\"\"x\n\nb = 1\n"),
              StartsWith("a.toml:2: not TOML: the string that begins at a.toml:2:5 has no closing "
                         "quote\n"));
  EXPECT_THAT(complaint("\"a = 1\n"), HasSubstr("begins at a.toml:1:1 has no closing quote"));
  // Here one in the middle is missing.
  EXPECT_THAT(complaint("a = [\"x, \"y\"]\n"),
              HasSubstr("saw 'y'; the string that begins at a.toml:1:12 has no closing quote"));
}

TEST(TomlDocument, BothPlacesOfAKeyGivenTwice) {
  EXPECT_EQ(complaint("[sim]\nseed = 1\n\n  seed = 2  # again\n"),
            "a.toml:4: not TOML: sim.seed is given twice; first given at a.toml:2:1\n"
            "    4:3 |   seed = 2  # again\n"
            "        |   ^^^^\n"
            "    2:1 | seed = 1\n"
            "        | ^^^^ first");
  EXPECT_EQ(complaint("[camera]\na = 1\n[head]\n[camera]\n"),
            "a.toml:4: not TOML: camera is given twice; first given at a.toml:1:2\n"
            "    4:2 | [camera]\n"
            "        |  ^^^^^^\n"
            "    1:2 | [camera]\n"
            "        |  ^^^^^^ first");
}

TEST(TomlDocument, KeysAreGivenTwiceInManyWays) {
  const auto twice = [](const char* text, const std::string& what) {
    EXPECT_THAT(complaint(text), HasSubstr(what)) << text;
  };
  twice("a.b = 1\na.b = 2\n", "2: not TOML: a.b is given twice; first given at a.toml:1:3");
  twice("a = 1\na.b = 2\n", "2: not TOML: a is given twice; first given at a.toml:1:1");
  twice("a = 1\n[a]\nb = 2\n", "2: not TOML: a is given twice; first given at a.toml:1:1");
  twice("a = [\n1]\na = [\n2]\n", "3: not TOML: a is given twice; first given at a.toml:1:1");
  twice("\"x = y\" = 1\n'x = y' = 2\n", "2: not TOML: x = y is given twice; first given at");
  twice("[[t]]\nx = 1\n[[t]]\nx = 2\nx = 3\n",
        "5: not TOML: t.x is given twice; first given at a.toml:4:1");
  twice("[a.b]\nc = 1\n[a]\nb = 2\n", "4: not TOML: a.b is given twice; first given at a.toml:1:4");
  twice(
      "\xEF\xBB\xBF"
      "a = 1\na = 2\n",
      "2: not TOML: a is given twice; first given at a.toml:1:1");
  twice("t = {a = 1, b = 2, a = 3}\n",
        "1: not TOML: t.a is given twice; first given at a.toml:1:6\n"
        "   1:20 | t = {a = 1, b = 2, a = 3}\n"
        "        |                    ^\n"
        "    1:6 | t = {a = 1, b = 2, a = 3}\n"
        "        |      ^ first");
  twice("[[p]]\nt = [{}, { 'a,' = \"}{,\", b = { c = 1, 'd' = [\n2, 3], d = 4 } }]\n",
        "3: not TOML: p.t.b.d is given twice; first given at a.toml:2:39");
}

TEST(TomlDocument, WhatBreaksAnAssertionOfTheParserIsAnError) {
  EXPECT_EQ(complaint("a = 1\n  [$x]\n"),
            "a.toml:2: not TOML: this cannot stand here\n"
            "    2:4 |   [$x]\n"
            "        |    ^");
  EXPECT_THAT(complaint("a = [1, }"), StartsWith("a.toml:1: not TOML: this cannot stand here\n"));
  EXPECT_THAT(complaint("a = 1979-05-27 x\nb = 1"), StartsWith("a.toml:1: not TOML: "));
  EXPECT_THAT(complaint("a = \"\"\"\n[$x]\n\"\"\"\nb = \n"), StartsWith("a.toml:4: not TOML: "));
}

TEST(TomlDocument, OfALongLineTheNeighbourhoodIsShown) {
  const std::string spaces(200, ' ');
  const std::string message = complaint("a = [1" + spaces + "2" + spaces + "]");
  EXPECT_THAT(message, HasSubstr("\n  1:207 | ..." + std::string(40, ' ') + "2 "));
  EXPECT_THAT(message, EndsWith("\n        | " + std::string(43, ' ') + "^"));
}

}  // namespace
}  // namespace gazed::base::toml_document_test
