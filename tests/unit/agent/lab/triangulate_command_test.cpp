// gazelab triangulate as a user runs it.
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <sstream>
#include <string>
#include <vector>

#include "scratch.hpp"
#include "triangulated.hpp"

namespace gazed::lab::triangulate_command_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::StrEq;

constexpr const char* csv_header = "id,x1,y1,x2,y2\n";
/// A head that turned by 0.4 rad; the baseline is 23 mm.
constexpr const char* pair_text = R"(K1 = [[752, 0, 331], [0, 752, 253], [0, 0, 1]]
K2 = [[752, 0, 331], [0, 752, 253], [0, 0, 1]]
R = [[0.921061, 0, -0.389418], [0, 1, 0], [0.389418, 0, 0.921061]]
t = [-0.022863, 0, -0.004634]
pixel_sigma_px = 0.3
)";
/// The point (0.02, -0.03, 0.3) m, seen by both.
constexpr const char* good_row = "lamp,381.1333,177.8,4.696,172.2764\n";

class GazelabTriangulate : public ::testing::Test {
 protected:
  GazelabTriangulate() {
    write_text(pair_, pair_text);
    rows(good_row);
  }

  void rows(const std::string& text) { write_text(correspondences_, csv_header + text); }

  Outcome run(const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {"triangulate", pair_.string(), correspondences_.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_gazelab(arguments);
  }

  /// One run that must end so.
  void expect(int exit_code, const ::testing::Matcher<const std::string&>& error,
              const std::vector<std::string>& options = {}) {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_THAT(outcome.err, error);
  }

  ScratchFolder folder_;
  std::filesystem::path pair_ = folder_ / "pair.toml";
  std::filesystem::path correspondences_ = folder_ / "matches.csv";
};

TEST_F(GazelabTriangulate, LocatesAPoint) {
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "1 correspondence: 1 LOCATED\n");
  const auto points = points_of(outcome.out);
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_EQ(points[0].status, "LOCATED");
  constexpr double last_decimals_m = 1e-5;  // of the pair and the row above
  EXPECT_NEAR(points[0].numbers[0], 0.02, last_decimals_m);
  EXPECT_NEAR(points[0].numbers[1], -0.03, last_decimals_m);
  EXPECT_NEAR(points[0].numbers[2], 0.3, last_decimals_m);
}

TEST_F(GazelabTriangulate, KeepsOrderAndIds) {
  rows("007,381.1333,177.8,4.696,172.2764\n\"b,\"\"c\"\"\",nan,1,2,3\n,1,2,3,4\n007,1,2,3,inf\n");
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("\n007,LOCATED,"));
  EXPECT_THAT(outcome.out, HasSubstr("\n\"b,\"\"c\"\"\",INVALID_INPUT,nan,nan,nan,nan,nan,nan,nan,"
                                     "nan,nan,nan\n"));
  EXPECT_THAT(outcome.out,
              EndsWith("\n007,INVALID_INPUT,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan\n"));
  EXPECT_THAT(points_of(outcome.out), SizeIs(4));
  EXPECT_THAT(outcome.err, StartsWith("4 correspondences: 1 LOCATED, "));
  EXPECT_THAT(outcome.err, HasSubstr("2 INVALID_INPUT"));
}

TEST_F(GazelabTriangulate, EachStatusHasItsNumbersAndNoOthers) {
  rows(
      "far,331,253,12.98,253.4\n"     // may be at infinity
      "lost,381.1,177.8,4.7,222.3\n"  // 50 px off the epipolar line
      "behind,331,253,400,253\n");
  const auto points = points_of(run().out);
  ASSERT_THAT(points, SizeIs(3));
  EXPECT_EQ(points[0].status, "UNCERTAIN");
  EXPECT_EQ(points[1].status, "TARGET_LOST");
  EXPECT_EQ(points[2].status, "BEHIND_CAMERA");
  for (const Point& point : points) {
    for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(std::isnan(point.numbers[i])) << point.id;
    EXPECT_GE(point.numbers[8], 0.0) << point.id;  // residual
    EXPECT_GE(point.numbers[9], 0.0) << point.id;  // parallax
  }
}

TEST_F(GazelabTriangulate, NoBaselineIsDegenerate) {
  write_text(pair_, std::string(pair_text).replace(std::string(pair_text).find("t = ["), 29,
                                                   "t = [0, 0, 0]"));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("lamp,DEGENERATE,nan,"));
  EXPECT_THAT(outcome.err, HasSubstr("warning: " + pair_.string() + ":4: t: no baseline"));
}

TEST_F(GazelabTriangulate, ReadsStandardInputAndWritesStandardOutputOrAFile) {
  const std::string expected = run().out;
  const Outcome piped = run_gazelab({"triangulate", pair_.string(), "-", "--csv", "-"},
                                    {.standard_input = correspondences_, .path = {}});
  EXPECT_EQ(piped.exit_code, 0);
  EXPECT_EQ(piped.out, expected);
  const auto csv = folder_ / "points.csv";
  write_text(csv, "old");
  EXPECT_THAT(run({"--csv", csv.string()}).out, IsEmpty());
  EXPECT_EQ(file_text(csv), expected);
}

TEST_F(GazelabTriangulate, FilesBesideTheOutputStayAsTheyAre) {
  const auto csv = folder_ / "points.csv";
  correspondences_ = folder_ / "points.csv.part";
  rows(good_row);
  EXPECT_EQ(run({"--csv", csv.string()}).exit_code, 0);
  EXPECT_EQ(file_text(correspondences_), std::string(csv_header) + good_row);
  EXPECT_THAT(points_of(file_text(csv)), SizeIs(1));
}

TEST_F(GazelabTriangulate, MalformedRowEndsTheRunAndIsNamed) {
  rows(std::string(good_row) + "b,1,2,3\n" + good_row);
  const auto csv = folder_ / "points.csv";
  const Outcome outcome = run({"--csv", csv.string()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(correspondences_.string() +
                                     ":3: 4 fields in 'b,1,2,3', expected 5: id,x1,y1,x2,y2"));
  const Outcome piped = run_gazelab({"triangulate", pair_.string(), "-"},
                                    {.standard_input = correspondences_, .path = {}});
  EXPECT_EQ(piped.exit_code, 1);
  EXPECT_THAT(piped.err, HasSubstr("standard input:3: 4 fields"));
  std::filesystem::remove(pair_);
  std::filesystem::remove(correspondences_);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));  // nothing half written
}

TEST_F(GazelabTriangulate, EmptyAndMissingFiles) {
  write_text(correspondences_, "");
  expect(1, HasSubstr("matches.csv: is empty, expected the header id,x1,y1,x2,y2"));
  rows("");
  expect(0, StrEq("0 correspondences\n"));
  std::filesystem::remove(correspondences_);
  expect(1, HasSubstr("matches.csv: cannot be opened: No such file"));
  std::filesystem::remove(pair_);
  expect(2, HasSubstr("pair.toml: cannot be read: No such file"));
}

TEST_F(GazelabTriangulate, BadArgumentsAndPairs) {
  expect(2, AllOf(HasSubstr("magic"), HasSubstr("rectification, linear-mmse")),
         {"--method", "magic"});
  expect(2, HasSubstr("/nowhere/points.csv: cannot be written: No such file"),
         {"--csv", "/nowhere/points.csv"});
  EXPECT_EQ(run({"--csv", correspondences_.string()}).exit_code, 2);
  EXPECT_EQ(file_text(correspondences_), std::string(csv_header) + good_row);
  write_text(pair_, std::string(pair_text) + "pixel_sigma = 1\n");
  expect(2, HasSubstr("pair.toml:6: pixel_sigma: unknown key; the nearest known is "
                      "pixel_sigma_px"));
}

TEST_F(GazelabTriangulate, HelpShowsFilesThatWork) {
  const std::string help = run_gazelab({"triangulate", "--help"}).out;
  const auto indented = [&help](const std::string& first, const std::string& last) {
    const std::size_t start = help.find("  " + first);
    const std::size_t end = help.find('\n', help.find("  " + last, start));
    std::istringstream lines(help.substr(start, end - start));
    std::string text;
    for (std::string line; std::getline(lines, line);) text += line.substr(2) + "\n";
    return text;
  };
  write_text(pair_, indented("K1 = ", "relative_sigma_max"));
  write_text(correspondences_, indented("id,x1", "door"));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "2 correspondences: 2 LOCATED\n");
}

}  // namespace
}  // namespace gazed::lab::triangulate_command_test
