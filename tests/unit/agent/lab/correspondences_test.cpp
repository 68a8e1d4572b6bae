#include "agent/lab/correspondences.hpp"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <random>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scratch.hpp"

namespace gazed::lab::correspondences_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

constexpr const char* csv_header = "id,x1,y1,x2,y2\n";

std::vector<Correspondence> read_all(const std::filesystem::path& file) {
  CorrespondenceReader reader(file);
  std::vector<Correspondence> all;
  while (auto correspondence = reader.next()) all.push_back(*std::move(correspondence));
  return all;
}

std::vector<Correspondence> parsed_rows(const std::string& text) {
  const ScratchFolder folder;
  write_text(folder / "pairs.csv", text);
  return read_all(folder / "pairs.csv");
}

TEST(Correspondences, ReadsRows) {
  const auto rows = parsed_rows(std::string(csv_header) + "a,1,-2.5,+3e2,4\nb,.5,6.,7,8\n");
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[0].id, "a");
  EXPECT_EQ(rows[0].pixel_1, geometry::Pixel(1.0, -2.5));
  EXPECT_EQ(rows[0].pixel_2, geometry::Pixel(300.0, 4.0));
  EXPECT_EQ(rows[1].pixel_1, geometry::Pixel(0.5, 6.0));
}

TEST(Correspondences, IdsAreTextAndStayAsTheyAre) {
  const auto rows = parsed_rows(std::string(csv_header) +
                                "007,1,2,3,4\n\"a,\"\"b\"\"\",1,2,3,4\n,1,2,3,4\n 7 ,1,2,3,4\n"
                                "007,1,2,3,4\n");
  ASSERT_THAT(rows, SizeIs(5));
  EXPECT_EQ(rows[0].id, "007");
  EXPECT_EQ(rows[1].id, "a,\"b\"");
  EXPECT_EQ(rows[2].id, "");
  EXPECT_EQ(rows[3].id, " 7 ");
  EXPECT_EQ(rows[4].id, "007");
}

TEST(Correspondences, AcceptsWhatEditorsAndTablesWrite) {
  const auto rows =
      parsed_rows("\xEF\xBB\xBF\"id\",\"x1\",y1 , x2,y2\r\n\r\na, 1 ,\t2,3,4 \r\n\r\n");
  ASSERT_THAT(rows, SizeIs(1));
  EXPECT_EQ(rows[0].pixel_1, geometry::Pixel(1.0, 2.0));
  EXPECT_EQ(rows[0].pixel_2, geometry::Pixel(3.0, 4.0));
}

TEST(Correspondences, NotANumberIsANumber) {
  const auto rows = parsed_rows(std::string(csv_header) + "a,nan,NaN,-nan,inf\nb,-inf,1,2,3\n");
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_TRUE(std::isnan(rows[0].pixel_1.x()));
  EXPECT_TRUE(std::isinf(rows[0].pixel_2.y()));
  EXPECT_TRUE(std::isinf(rows[1].pixel_1.x()));
}

TEST(Correspondences, HeaderAloneIsNoRows) {
  EXPECT_THAT(parsed_rows(csv_header), IsEmpty());
}

struct BadRow {
  const char* name;
  const char* row;
  const char* message;
};

class CorrespondencesRefuse : public ::testing::TestWithParam<BadRow> {};

TEST_P(CorrespondencesRefuse, WithLineWhatWasReadAndWhatWasExpected) {
  const std::string text = std::string(csv_header) + "a,1,2,3,4\n\n" + GetParam().row + "\n";
  EXPECT_THAT([&] { static_cast<void>(parsed_rows(text)); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr(std::string("pairs.csv:4: ") + GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, CorrespondencesRefuse,
    ::testing::Values(
        BadRow{"TooFewFields", "b,1,2,3", "4 fields in 'b,1,2,3', expected 5: id,x1,y1,x2,y2"},
        BadRow{"TooManyFields", "b,1,2,3,4,5", "6 fields in 'b,1,2,3,4,5', expected 5"},
        BadRow{"Semicolons", "b;1;2;3;4", "1 fields in 'b;1;2;3;4', expected 5"},
        BadRow{"OpenQuote", "\"b,1,2,3,4", "quotes do not match in '\"b,1,2,3,4'"},
        BadRow{"NoNumber", "b,1,two,3,4", "y1 is 'two', expected a number of pixels, or nan, inf"},
        BadRow{"Empty", "b,1,2,,4", "x2 is '', expected a number"},
        BadRow{"TwoNumbers", "b,1 1,2,3,4", "x1 is '1 1', expected a number"},
        BadRow{"Unit", "b,1,2,3,4px", "y2 is '4px', expected a number"},
        BadRow{"Hexadecimal", "b,0x10,2,3,4", "x1 is '0x10', expected a number"},
        BadRow{"TooLarge", "b,1e999,2,3,4", "x1 is '1e999', beyond what a double can hold"},
        BadRow{"TooNearZero", "b,1,1e-400,3,4", "y1 is '1e-400', beyond what a double can hold"},
        BadRow{"PlusMinus", "b,1,+-2,3,4", "y1 is '+-2', expected a number"},
        BadRow{"TwoBadFields", "b,one,two,3,4", "x1 is 'one'"},
        BadRow{"TwoBadFieldsOfView2", "b,1,2,three,four", "x2 is 'three'"},
        BadRow{"ControlCharacters", "b,1,2,\x01\xff,4",
               "x2 is '?"
               "?', expected a number"}),
    [](const auto& row) { return row.param.name; });

TEST(Correspondences, ALongFieldIsShownShort) {
  EXPECT_THAT(
      [] {
        static_cast<void>(
            parsed_rows(csv_header + std::string("a,") + std::string(9000, 'x') + ",2,3,4\n"));
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("xxx...', expected a number")));
}

TEST(Correspondences, AnotherHeaderIsRefused) {
  for (const char* text : {"id,u1,v1,u2,v2\n", "1,2,3,4,5\n", "id,x1,y1,x2\n", "\"id,x1\n"}) {
    EXPECT_THAT([&] { static_cast<void>(parsed_rows(text)); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("pairs.csv:1: the header is '"),
                                                        HasSubstr("', expected 'id,x1,y1,x2,y2'"))))
        << text;
  }
}

TEST(Correspondences, EmptyFileIsRefused) {
  for (const char* text : {"", "\n \n", "\xEF\xBB\xBF"}) {
    EXPECT_THAT([&] { static_cast<void>(parsed_rows(text)); },
                ThrowsMessage<std::runtime_error>(
                    HasSubstr("pairs.csv: is empty, expected the header id,x1,y1,x2,y2")))
        << text;
  }
}

TEST(Correspondences, AnyBytesAreRowsOrAnErrorWithItsLine) {
  const ScratchFolder folder;
  const auto file = folder / "pairs.csv";
  const std::regex error(".*pairs\\.csv(:[0-9]+: [^\\n]+|: is empty, expected .*)");
  std::mt19937_64 random(2);
  constexpr std::string_view alphabet = "0123456789.,-einaf\"\r\n \t\xEF";
  int accepted = 0, refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = std::string(csv_header) + "a,1,2,3,4\nb,5.5,-6,7e1,nan\n";
    if (trial % 3 == 0) text.assign(random() % 200, ' ');
    for (std::size_t changes = random() % (trial % 3 == 0 ? 400 : 4); changes > 0; --changes) {
      if (text.empty()) break;
      const bool any_byte = random() % 2 == 0;
      text[random() % text.size()] =
          any_byte ? static_cast<char>(random()) : alphabet[random() % alphabet.size()];
    }
    write_text(file, text);
    try {
      static_cast<void>(read_all(file));
      ++accepted;
    } catch (const std::runtime_error& failure) {
      EXPECT_TRUE(std::regex_match(failure.what(), error)) << failure.what();
      ++refused;
    }
  }
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace gazed::lab::correspondences_test
