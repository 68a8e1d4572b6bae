// The program itself: what it prints, writes and returns.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <gmock/gmock.h>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "agent/lab/io/csv.hpp"

#include "scratch.hpp"

namespace gazed::lab::saliency_command_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.push_back(io::split_csv_line(line).value_or(std::vector<std::string>{}));
  }
  return rows;
}

/// Two pictures, and the same of both but their names.
void expect_two_alike(const Rows& rows) {
  ASSERT_THAT(rows, SizeIs(3));
  for (std::size_t column = 1; column < rows[1].size(); ++column) {
    EXPECT_EQ(rows[2][column], rows[1][column]) << rows[0][column];
  }
}

class GazelabSaliency : public ::testing::Test {
 protected:
  std::string disc(const std::string& name, cv::Size size = {640, 480},
                   cv::Point2d centre_px = {200, 150}, double radius_px = 25) {
    const auto file = (folder_ / name).string();
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    cv::imwrite(file, red_disc(size, centre_px, radius_px));
    return file;
  }

  ScratchFolder folder_;
};

TEST_F(GazelabSaliency, HelpNamesTheFormats) {
  const Outcome run = run_gazelab({"saliency", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("image,x_px,y_px,saliency,distinctness,distinct"),
                             HasSubstr("Examples"), HasSubstr("--overlay")));
}

TEST_F(GazelabSaliency, VersionIsPrinted) {
  const Outcome run = run_gazelab({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, "gazelab " GAZED_VERSION "\n");
}

// The place of a drawn disc, in the picture's own pixels, whatever its size. The quadratic fit
// finds a disc's centre in the map to a few tenths of a cell of 16 px; leaving out the half pixels
// of the resampling, or adding half a cell, is 8 px in the working frame and fails.
TEST_F(GazelabSaliency, WinnerIsOnTheDiscInThePicturesOwnPixels) {
  constexpr double tolerance_px = 5.0;  // in the working frame
  for (const std::string profile : {"report", "robust"}) {
    for (const cv::Size size : {cv::Size(320, 240), cv::Size(640, 426), cv::Size(640, 480),
                                cv::Size(1920, 1280), cv::Size(480, 640)}) {
      const double scale = 640.0 / std::max(size.width, size.height);
      const cv::Point2d centre(0.31 * size.width, 0.36 * size.height);
      const std::string file = disc("disc.png", size, centre, 20.0 / scale);
      const Outcome run = run_gazelab({"saliency", "--profile", profile, "--csv", "-", file});
      ASSERT_EQ(run.exit_code, 0) << run.err;
      const Rows rows = rows_of(run.out);
      ASSERT_THAT(rows, SizeIs(2));
      EXPECT_THAT(rows[0],
                  ElementsAre("image", "x_px", "y_px", "saliency", "distinctness", "distinct"));
      EXPECT_EQ(rows[1][0], file);
      EXPECT_NEAR(std::stod(rows[1][1]), centre.x, tolerance_px / scale) << profile << size;
      EXPECT_NEAR(std::stod(rows[1][2]), centre.y, tolerance_px / scale) << profile << size;
      EXPECT_GT(std::stod(rows[1][3]), 0.0);
    }
  }
}

TEST_F(GazelabSaliency, CsvGoesToAPipeWithoutBeingAskedFor) {
  const std::string file = disc("a.png");
  EXPECT_EQ(run_gazelab({"saliency", file}).out, run_gazelab({"saliency", file, "--csv", "-"}).out);
}

TEST_F(GazelabSaliency, CsvGoesToAFile) {
  const std::string first = disc("a.png");
  const std::string second = disc("with, comma.png");
  const auto csv = folder_ / "winners.csv";
  const Outcome run = run_gazelab({"saliency", first, second, "--csv", csv.string()});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, IsEmpty());
  const Rows rows = rows_of(file_text(csv));
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_EQ(rows[1][0], first);
  EXPECT_EQ(rows[2][0], second);
}

TEST_F(GazelabSaliency, MapIsSixteenBitWithItsMaximumAtFullScale) {
  const std::string file = disc("disc.jpg", {800, 600});
  const auto maps = folder_ / "new" / "maps";
  ASSERT_EQ(run_gazelab({"saliency", file, "--maps", maps.string()}).exit_code, 0);
  const std::string bytes = file_text(maps / "disc.pgm");
  constexpr std::string_view pgm_header = "P5\n40 30\n65535\n";
  ASSERT_TRUE(bytes.starts_with(pgm_header));
  ASSERT_EQ(bytes.size(), pgm_header.size() + 2 * 40 * 30);
  int peak = 0, peak_at = 0;
  for (int i = 0; i < 40 * 30; ++i) {
    const auto byte = [&](int k) {
      return static_cast<unsigned char>(bytes[pgm_header.size() + k]);
    };
    const int sample = byte(2 * i) << 8 | byte(2 * i + 1);
    if (sample > peak) peak = sample, peak_at = i;
  }
  EXPECT_EQ(peak, 65535);
  // The disc at (200, 150) of 800x600 is at (160, 120) of the working frame: sample (10, 7.5).
  EXPECT_NEAR(peak_at % 40, 10, 1);
  EXPECT_NEAR(peak_at / 40, 7.5, 1.5);
}

TEST_F(GazelabSaliency, OverlayMarksTheWinner) {
  const std::string file = disc("disc.png", {800, 600}, {600, 200});
  const auto overlays = folder_ / "overlays";
  ASSERT_EQ(run_gazelab({"saliency", file, "--overlay", overlays.string()}).exit_code, 0);
  const cv::Mat picture = cv::imread(file);
  const cv::Mat overlay = cv::imread((overlays / "disc.png").string());
  ASSERT_EQ(overlay.size(), picture.size());
  const cv::Rect winner(560, 160, 80, 80);
  EXPECT_GT(cv::norm(overlay(winner), picture(winner), cv::NORM_L1) / winner.area(), 30.0);
}

TEST_F(GazelabSaliency, DistinctIsWhatGazedWouldLookAt) {
  const std::string one = disc("one.png");
  const auto wall = (folder_ / "wall.png").string();
  cv::imwrite(wall, cv::Mat(480, 640, CV_8UC3, cv::Scalar(150, 150, 150)));
  const Rows rows = rows_of(run_gazelab({"saliency", "--csv", "-", one, wall}).out);
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_EQ(rows[1].back(), "yes");
  EXPECT_EQ(rows[2].back(), "no");
}

TEST_F(GazelabSaliency, FolderMeansThePicturesInIt) {
  const std::string second = disc("walk/b.png"), first = disc("walk/a.JPG");
  write_text(folder_ / "walk" / "frames.csv", "utime_us,file\n");
  std::filesystem::create_directory(folder_ / "walk" / "inside");
  const Outcome run = run_gazelab({"saliency", "--csv", "-", (folder_ / "walk").string()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Rows rows = rows_of(run.out);
  ASSERT_THAT(rows, SizeIs(3));
  EXPECT_EQ(rows[1][0], first);
  EXPECT_EQ(rows[2][0], second);
  const Outcome none = run_gazelab({"saliency", (folder_ / "walk" / "inside").string()});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("a folder without pictures"));
}

TEST_F(GazelabSaliency, EqualNamesOfSeveralFoldersAreKeptApart) {
  const std::string first = disc("one/same.png");
  const std::string second = disc("two/same.jpg");
  const auto maps = folder_ / "maps";
  EXPECT_EQ(run_gazelab({"saliency", first, second, "--maps", maps.string()}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(maps / "one" / "same.pgm"));
  EXPECT_TRUE(std::filesystem::exists(maps / "two" / "same.pgm"));
}

TEST_F(GazelabSaliency, OneStemTwiceEndsBeforeAnyWork) {
  const std::string first = disc("one/same.png");
  const std::string second = disc("one/same.jpg");
  const auto maps = folder_ / "maps";
  const Outcome run = run_gazelab({"saliency", first, second, "--maps", maps.string()});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr(first), HasSubstr(second), HasSubstr("same.pgm")));
  EXPECT_FALSE(std::filesystem::exists(maps));
  EXPECT_EQ(run_gazelab({"saliency", first, second}).exit_code, 0);
}

TEST_F(GazelabSaliency, PictureThatIsTooSmallToJudgeIsCalledSo) {
  const Outcome small = run_gazelab({"saliency", disc("small.png", {100, 75}, {30, 20}, 5)});
  EXPECT_EQ(small.exit_code, 0);
  EXPECT_THAT(small.err, HasSubstr("small.png: too small to judge, gazed takes 160x120 and more"));
  EXPECT_THAT(run_gazelab({"saliency", disc("large.png")}).err, IsEmpty());
}

// A sensor of 12 bit fills the lower bits of 16.
TEST_F(GazelabSaliency, TwelveBitsInSixteenAreSeen) {
  const std::string eight = disc("eight.png");
  const cv::Mat picture = cv::imread(eight);
  cv::Mat twelve;
  picture.convertTo(twelve, CV_16U, 16.0);
  const auto file = (folder_ / "twelve.png").string();
  cv::imwrite(file, twelve);
  expect_two_alike(rows_of(run_gazelab({"saliency", "--csv", "-", eight, file}).out));
}

TEST_F(GazelabSaliency, JpegWithoutItsEndMarkerIsThePicture) {
  const std::string whole = disc("whole.jpg");
  const std::string bytes = file_text(whole);
  const auto cut = folder_ / "cut.jpg";
  write_cut(whole, cut, bytes.size() - 2);
  const Outcome run = run_gazelab({"saliency", "--csv", "-", whole, cut.string()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  expect_two_alike(rows_of(run.out));
}

TEST_F(GazelabSaliency, NoPictureIsOverwritten) {
  const std::string file = disc("a.png");
  const std::string before = file_text(file);
  const Outcome overlay = run_gazelab({"saliency", file, "--overlay", folder_.path().string()});
  EXPECT_EQ(overlay.exit_code, 2);
  EXPECT_THAT(overlay.err, HasSubstr("would overwrite the input " + file));
  EXPECT_EQ(run_gazelab({"saliency", file, "--csv", file}).exit_code, 2);
  EXPECT_EQ(file_text(file), before);
}

TEST_F(GazelabSaliency, BadPicturesAreNamedAndTheOthersDone) {
  const std::string good = disc("good.png");
  const std::string whole_jpeg = disc("whole.jpg");
  write_cut(good, folder_ / "cut.png", 700);
  write_cut(whole_jpeg, folder_ / "cut.jpg", 4000);
  write_text(folder_ / "empty.png", "");
  write_text(folder_ / "text.png", "no picture");
  const std::string narrow = disc("narrow.png", {1000, 100});
  std::vector<std::string> arguments = {"saliency", "--csv", "-"};
  const std::map<std::string, std::string> bad = {
      {"cut.png", "ends early"},       {"cut.jpg", "ends early"},
      {"empty.png", "empty"},          {"text.png", "not a picture"},
      {"missing.png", "No such file"}, {"narrow.png", "1000x100, scaled to 640x64"}};
  for (const auto& [name, why] : bad) arguments.push_back((folder_ / name).string());
  arguments.push_back(good);
  const Outcome run = run_gazelab(arguments);
  EXPECT_EQ(run.exit_code, 1);
  for (const auto& [name, why] : bad) {
    EXPECT_THAT(run.err, HasSubstr((folder_ / name).string() + ": ")) << name;
    EXPECT_THAT(run.err, HasSubstr(why)) << name;
  }
  const Rows rows = rows_of(run.out);
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[1][0], good);
}

TEST_F(GazelabSaliency, BadArgumentsSayWhatIsAllowed) {
  const std::string file = disc("a.png");
  const Outcome profile = run_gazelab({"saliency", "--profile", "fast", file});
  EXPECT_EQ(profile.exit_code, 2);
  EXPECT_THAT(profile.err, AllOf(HasSubstr("fast"), HasSubstr("report"), HasSubstr("robust")));
  const Outcome option = run_gazelab({"saliency", "--colour", file});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, AllOf(HasSubstr("--colour"), HasSubstr("--profile")));
  const Outcome command = run_gazelab({"salience", file});
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_THAT(command.err, AllOf(HasSubstr("salience"), HasSubstr("saliency"), HasSubstr("log")));
  EXPECT_EQ(run_gazelab({"saliency"}).exit_code, 2);
  EXPECT_EQ(run_gazelab({}).exit_code, 2);
  EXPECT_EQ(run_gazelab({"saliency", file, "--csv", "/nowhere/at/all.csv"}).exit_code, 2);
  EXPECT_EQ(run_gazelab({"saliency", file, "--maps", file}).exit_code, 2);
}

TEST_F(GazelabSaliency, FullDiskIsReported) {
  const Outcome run = run_gazelab({"saliency", disc("a.png"), "--csv", "/dev/full"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("/dev/full: could not be written"));
}

}  // namespace
}  // namespace gazed::lab::saliency_command_test
