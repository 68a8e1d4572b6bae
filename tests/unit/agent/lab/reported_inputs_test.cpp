// Inputs that people reported, where they are at hand: what each of them leads to.
#include <algorithm>
#include <array>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/settings/settings.hpp"
#include "drivers/log/log_camera.hpp"

#include "scratch.hpp"

namespace gazed::lab::reported_inputs_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ReportedInputs : public ::testing::Test {
 protected:
  static fs::path folder_of(const std::string& name) {
    return fs::path(GAZED_SHARED) / "cases" / name;
  }
  static std::vector<std::string> pictures_in(const fs::path& folder, const std::string& begin) {
    std::vector<std::string> files;
    if (!fs::is_directory(folder)) return files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const fs::path& file = entry.path();
      const bool is_picture = file.extension() == ".jpg" || file.extension() == ".png";
      if (is_picture && file.filename().string().starts_with(begin)) files.push_back(file);
    }
    std::ranges::sort(files);
    return files;
  }
  [[nodiscard]] std::string out() const { return scratch_ / "camera.toml"; }
  [[nodiscard]] Outcome calibrate(std::vector<std::string> pictures, const std::string& board,
                                  const std::string& square) const {
    std::vector<std::string> arguments{"calibrate", "--board", board, "--square",
                                       square,      "--out",   out()};
    arguments.insert(arguments.end(), pictures.begin(), pictures.end());
    return run_gazelab(arguments);
  }

  ScratchFolder scratch_;
};

TEST_F(ReportedInputs, BoardsParallelToTheImageAreRefused) {
  const fs::path folder = folder_of("01-calib-parallel-boards");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const Outcome run = calibrate(pictures_in(folder, "p"), "9x6", "0.025");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("do not determine the focal length"),
                             HasSubstr("tilt the board by 20 to 40 degrees")));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(ReportedInputs, AsManyCornersAsUnknownsAreRefused) {
  const fs::path folder = folder_of("03-calib-nan-sigma");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const Outcome run = calibrate(pictures_in(folder, "p"), "3x3", "0.05");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("more pictures or a larger board"));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(ReportedInputs, TwoOddPicturesOfThirteenAreNamedAndTheRestIsCalibrated) {
  const fs::path folder = fs::path(GAZED_SHARED) / "data" / "opencv_calib";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::vector<std::string> files = pictures_in(folder, "left");
  ASSERT_GE(files.size(), 8U);
  std::vector<std::string> sound = files;
  std::array<std::string, 2> odd;
  for (std::size_t i = 0; i < odd.size(); ++i) {
    std::string& file = files[7 * i];
    odd[i] = scratch_ / fs::path(file).filename();
    cv::Mat wider;
    cv::copyMakeBorder(cv::imread(file), wider, 0, 1, 0, 1, cv::BORDER_REPLICATE);
    cv::imwrite(odd[i], wider);
    sound.erase(std::ranges::find(sound, file));
    file = odd[i];
  }
  ASSERT_EQ(calibrate(sound, "9x6", "0.025").exit_code, 0);
  const std::string expected = file_text(out());
  const Outcome run = calibrate(files, "9x6", "0.025");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string& file : odd)
    EXPECT_THAT(run.err, HasSubstr("not used: " + file + ": is 641x481, most are 640x480"));
  EXPECT_EQ(file_text(out()), expected);
}

TEST_F(ReportedInputs, OrientationTagsChangeNothing) {
  using namespace std::string_literals;
  const fs::path folder = fs::path(GAZED_SHARED) / "data" / "opencv_calib";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const std::string exif =
      "\xFF\xE1\0\x22"
      "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0\0\0\0\0"s;
  std::vector<std::string> files = pictures_in(folder, "left");
  ASSERT_EQ(calibrate(files, "9x6", "0.025").exit_code, 0);
  const std::string expected = file_text(out());
  for (std::size_t i = 0; i < files.size(); i += 2) {
    const std::string coded = file_text(files[i]);
    files[i] = scratch_ / fs::path(files[i]).filename();
    write_text(files[i], coded.substr(0, 2) + exif + coded.substr(2));
  }
  ASSERT_EQ(calibrate(files, "9x6", "0.025").exit_code, 0);
  EXPECT_EQ(file_text(out()), expected);
  const settings::Settings found =
      settings::load_settings({.environment = {}, .file = out(), .command_line = {}}, {});
  // mrcal 2.2 on corners found in the same way: 533.2.
  EXPECT_GT(found.rig.camera.focal_px.x(), 532.5);
  EXPECT_LT(found.rig.camera.focal_px.x(), 534.0);
}

TEST_F(ReportedInputs, AJpegThatLacksItsEndMarkerIsWholeAndHalfAPictureIsNot) {
  const fs::path folder = folder_of("08-jpeg-without-eoi");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const auto answer = [&](const char* name) {
    const Outcome run = run_gazelab({"saliency", folder / name, "--csv", "-"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::size_t row = run.out.find('\n') + 1;
    return run.out.substr(run.out.find(',', row));  // without the picture's name
  };
  EXPECT_EQ(answer("whole_without_eoi.jpg"), answer("whole.jpg"));
  const Outcome half = run_gazelab({"saliency", folder / "cut_in_half.jpg", "--csv", "-"});
  EXPECT_NE(half.exit_code, 0);
  EXPECT_THAT(half.err, HasSubstr("the picture ends early"));
}

TEST_F(ReportedInputs, DistortionsOfFourNumbersAndWithZerosBehindAreTaken) {
  const fs::path folder = folder_of("11-distortion-4-8-14");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const auto run = [&](const char* pair) {
    return run_gazelab({"triangulate", folder / pair, folder / "matches.csv", "--csv", "-"});
  };
  const Outcome four = run("pair4.toml"), fourteen = run("pair14_zero_tail.toml");
  EXPECT_EQ(four.exit_code, 0) << four.err;
  EXPECT_EQ(fourteen.exit_code, 0) << fourteen.err;
  EXPECT_THAT(four.out, HasSubstr("LOCATED"));
  const Outcome rational = run("pair8.toml");
  EXPECT_EQ(rational.exit_code, 2);
  EXPECT_THAT(rational.err, HasSubstr("the rational model is not gazed's: calibrate with 5"));
}

TEST_F(ReportedInputs, WhatIsNoLogIsCalledSo) {
  const fs::path folder = folder_of("15-not-a-log");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const auto refusal = [&](const char* name) -> std::string {
    try {
      const log::LogCamera camera(folder / name, lcm::Channels("GAZED"), 640, 480);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal("text.lcm"), HasSubstr("is no LCM log"));
  EXPECT_THAT(refusal("walk.lcm.gz"), HasSubstr("unpack it first: gunzip"));
}

}  // namespace
}  // namespace gazed::lab::reported_inputs_test
