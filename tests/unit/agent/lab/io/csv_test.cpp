#include "agent/lab/io/csv.hpp"

#include <gmock/gmock.h>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace gazed::lab::io::csv_test {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

TEST(Csv, SplitsAtCommas) {
  EXPECT_THAT(split_csv_line("1,a.png,0.5,-0.5"),
              Optional(ElementsAre("1", "a.png", "0.5", "-0.5")));
}

TEST(Csv, KeepsEmptyFields) {
  EXPECT_THAT(split_csv_line(""), Optional(ElementsAre("")));
  EXPECT_THAT(split_csv_line(",a,"), Optional(ElementsAre("", "a", "")));
}

TEST(Csv, ReadsQuotes) {
  EXPECT_THAT(split_csv_line(R"("a,b","say ""hi""",c)"),
              Optional(ElementsAre("a,b", R"(say "hi")", "c")));
}

TEST(Csv, RefusesQuotesThatDoNotMatch) {
  EXPECT_FALSE(split_csv_line(R"("open)"));
  EXPECT_FALSE(split_csv_line(R"("a"b,c)"));
  EXPECT_FALSE(split_csv_line(R"(")"));
}

TEST(Csv, WhatIsWrittenIsReadBack) {
  std::mt19937_64 random(1);
  constexpr std::string_view alphabet = "ab,\"' .";
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<std::string> fields(1 + random() % 4);
    std::string line;
    for (std::string& field : fields) {
      for (std::size_t n = random() % 6; n > 0; --n) field += alphabet[random() % alphabet.size()];
      if (&field != &fields.front()) line += ',';
      line += csv_field(field);
    }
    EXPECT_EQ(split_csv_line(line), fields) << line;
  }
}

}  // namespace
}  // namespace gazed::lab::io::csv_test
