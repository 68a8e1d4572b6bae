#include "agent/lab/io/frames_csv.hpp"

#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/agent/lab/scratch.hpp"

namespace gazed::lab::io::frames_csv_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

constexpr const char* csv_header = "utime_us,file,yaw_rad,pitch_rad\n";

std::vector<RecordedFrame> parsed(const std::string& text) {
  const ScratchFolder folder;
  write_text(folder / "frames.csv", text);
  return read_frames_csv(folder / "frames.csv");
}

TEST(FramesCsv, ReadsRows) {
  const auto frames =
      parsed(std::string(csv_header) +
             "1700000000000000,a.jpg,0,0\n1700000000500000,\"b, c.png\",-0.125,1e-1\n");
  ASSERT_THAT(frames, SizeIs(2));
  EXPECT_EQ(frames[0].utime_us, 1700000000000000);
  EXPECT_EQ(frames[1].file, "b, c.png");
  EXPECT_EQ(frames[1].head, (geometry::HeadAngles{-0.125, 0.1}));
  EXPECT_EQ(frames[1].line, 3);
}

TEST(FramesCsv, AcceptsWhatEditorsWrite) {
  const auto frames =
      parsed("\xEF\xBB\xBFutime_us,file,yaw_rad,pitch_rad\r\n\r\n 1000 , a.jpg , 0 , 0 \r\n\r\n");
  ASSERT_THAT(frames, SizeIs(1));
  EXPECT_EQ(frames[0].file, "a.jpg");
  EXPECT_EQ(frames[0].line, 3);
}

struct BadRow {
  const char* name;
  const char* row;
  const char* what_was_read;
};

class FramesCsvRefuses : public ::testing::TestWithParam<BadRow> {};

TEST_P(FramesCsvRefuses, WithLineAndWhatWasRead) {
  const std::string text = std::string(csv_header) + "5000,a.jpg,0,0\n" + GetParam().row + "\n";
  EXPECT_THAT([&] { static_cast<void>(parsed(text)); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("frames.csv:3: "), HasSubstr(GetParam().what_was_read))));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, FramesCsvRefuses,
    ::testing::Values(BadRow{"TooFewFields", "9000,b.jpg,0", "3 fields in '9000,b.jpg,0'"},
                      BadRow{"TooManyFields", "9000,b.jpg,0,0,0", "5 fields"},
                      BadRow{"OpenQuote", "9000,\"b.jpg,0,0", "quotes"},
                      BadRow{"NoFile", "9000,,0,0", "file name is empty"},
                      BadRow{"TimeNotANumber", "soon,b.jpg,0,0", "'soon'"},
                      BadRow{"TimeWithFraction", "9000.5,b.jpg,0,0", "'9000.5'"},
                      BadRow{"TimeNegative", "-9000,b.jpg,0,0", "'-9000'"},
                      BadRow{"TimeTooLarge", "99999999999999999999,b.jpg,0,0",
                             "'99999999999999999999'"},
                      BadRow{"TimeRepeated", "5000,b.jpg,0,0", "line 2 has 5000"},
                      BadRow{"TimeBackwards", "4000,b.jpg,0,0", "line 2 has 5000"},
                      BadRow{"TimeTooClose", "5999,b.jpg,0,0", "1000 to 60000000 us after"},
                      BadRow{"TimeTooFar", "60005001,b.jpg,0,0", "60005001"},
                      BadRow{"YawNaN", "9000,b.jpg,nan,0", "yaw_rad is 'nan'"},
                      BadRow{"YawInfinite", "9000,b.jpg,inf,0", "yaw_rad is 'inf'"},
                      BadRow{"YawInDegrees", "9000,b.jpg,-15.0,0", "yaw_rad is '-15.0'"},
                      BadRow{"PitchBeyondPi", "9000,b.jpg,0,3.15", "pitch_rad is '3.15'"},
                      BadRow{"PitchEmpty", "9000,b.jpg,0,", "pitch_rad is ''"},
                      BadRow{"PitchWithUnit", "9000,b.jpg,0,0.1rad", "pitch_rad is '0.1rad'"}),
    [](const auto& row) { return row.param.name; });

TEST(FramesCsv, AnotherHeaderIsRefused) {
  EXPECT_THAT([] { static_cast<void>(parsed("time,file,yaw,pitch\n1,a.jpg,0,0\n")); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("frames.csv:1: the header is 'time,file,yaw,pitch'"),
                        HasSubstr("expected 'utime_us,file,yaw_rad,pitch_rad'"))));
}

TEST(FramesCsv, EmptyFileIsRefused) {
  EXPECT_THAT([] { static_cast<void>(parsed("")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("frames.csv: is empty")));
  EXPECT_THAT([] { static_cast<void>(parsed(csv_header)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no frames after the header")));
}

TEST(FramesCsv, MissingFileIsNamed) {
  const ScratchFolder folder;
  EXPECT_THAT([&] { static_cast<void>(read_frames_csv(folder / "frames.csv")); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr((folder / "frames.csv").string() + ": cannot be opened")));
}

TEST(FramesCsv, WhateverIsReadIsInOrderAndInRange) {
  const ScratchFolder folder;
  const auto file = folder / "frames.csv";
  std::mt19937_64 random(3);
  constexpr std::string_view alphabet = "0123456789.,-en\"\n a";
  const std::size_t rows_at = std::string_view(csv_header).size();
  int accepted = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string text = std::string(csv_header) + "1000,a.jpg,0.1,-0.2\n3000,b.jpg,0.3,0\n";
    for (std::size_t changes = random() % 4; changes > 0; --changes) {
      text[rows_at + random() % (text.size() - rows_at)] = alphabet[random() % alphabet.size()];
    }
    write_text(file, text);
    try {
      std::int64_t before_us = -least_frame_interval_us;
      for (const RecordedFrame& frame : read_frames_csv(file)) {
        EXPECT_GE(frame.utime_us, before_us + least_frame_interval_us) << text;
        EXPECT_LE(std::abs(frame.head.yaw_rad), std::numbers::pi) << text;
        EXPECT_LE(std::abs(frame.head.pitch_rad), std::numbers::pi) << text;
        EXPECT_FALSE(frame.file.empty()) << text;
        before_us = frame.utime_us;
      }
      ++accepted;
    } catch (const std::runtime_error&) {  // refused, which is as good
    }
  }
  EXPECT_GT(accepted, 100);
}

}  // namespace
}  // namespace gazed::lab::io::frames_csv_test
