// gazelab calibrate on pictures of a chessboard alone: which it uses, and what it refuses to know.
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <gmock/gmock.h>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/calibrated_settings.hpp"
#include "agent/settings/settings.hpp"

#include "rendered_board.hpp"
#include "scratch.hpp"

namespace gazed::lab::calibration::camera_command_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double degree = std::numbers::pi / 180.0;
const Chessboard board{.columns = 9, .rows = 6, .square_m = 0.02};

const BoardRenderer& renderer() {
  static const BoardRenderer one(rendered_camera(), board);
  return one;
}

/// Pictures of a board held at up to `tilt_rad`.
const std::vector<cv::Mat>& tilted_boards() {
  static const std::vector<cv::Mat> pictures = [] {
    std::vector<cv::Mat> all;
    for (const BoardPose& pose : board_poses(6, 40.0 * degree, 11)) {
      all.push_back(renderer().picture(pose, all.size()));
    }
    return all;
  }();
  return pictures;
}

class CameraFromBoard : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(pictures()); }

  [[nodiscard]] std::filesystem::path pictures() const { return scratch_ / "pictures"; }
  [[nodiscard]] std::string file(const std::string& name) const {
    return (pictures() / name).string();
  }
  [[nodiscard]] std::string out() const { return (scratch_ / "camera.toml").string(); }

  void write_tilted_boards(const std::string& ending = ".png") {
    for (std::size_t i = 0; i < tilted_boards().size(); ++i) {
      cv::imwrite(file(base::text("board%zu", i) + ending), tilted_boards()[i]);
    }
  }

  [[nodiscard]] Outcome calibrate(const std::string& size = "9x6") {
    return run_gazelab(
        {"calibrate", "--board", size, "--square", "0.02", "--out", out(), pictures().string()});
  }

  [[nodiscard]] settings::Settings read_back() const {
    return settings::load_settings({.environment = {}, .file = out(), .command_line = {}}, {});
  }

  ScratchFolder scratch_;
};

TEST_F(CameraFromBoard, FolderOfPicturesIsTaken) {
  write_tilted_boards();
  const Outcome run = calibrate();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(read_back().rig.camera.focal_px.x(), 540.0, 6.0);
  EXPECT_NEAR(read_back().rig.camera.centre_px.y(), 235.0, 4.0);
}

TEST_F(CameraFromBoard, FolderWithoutPicturesIsRefused) {
  write_text(file("notes.txt"), "no picture");
  const Outcome run = calibrate();
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr(pictures().string() + ": holds no pictures; needed: a folder of"));
}

TEST_F(CameraFromBoard, WhatDoesNotExistIsSaidSo) {
  const Outcome run = run_gazelab({"calibrate", file("nothing")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("nothing: cannot be opened: No such file or directory"));
}

TEST_F(CameraFromBoard, OutOfAnotherKindIsRefusedBeforeAnythingIsRead) {
  for (const char* name : {"x.jpg", "x.PNG", "walk.lcm", "marks.csv"}) {
    const Outcome run = run_gazelab({"calibrate", "--out", file(name), pictures().string()});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, AllOf(HasSubstr("--out: '"), HasSubstr("allowed: FILE.toml"))) << name;
  }
}

TEST_F(CameraFromBoard, BoardsParallelToTheImageTellNoFocalLength) {
  std::size_t i = 0;
  for (const BoardPose& pose : board_poses(6, 1.0 * degree, 5)) {
    cv::imwrite(file(base::text("board%zu.png", i)), renderer().picture(pose, i));
    ++i;
  }
  const Outcome run = calibrate();
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("the pictures do not determine the focal length"),
                             HasSubstr("tilt the board by 20 to 40 degrees")));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(CameraFromBoard, FewerCornersThanUnknownsAreRefused) {
  const Chessboard small{.columns = 3, .rows = 3, .square_m = 0.05};
  const BoardRenderer small_renderer(rendered_camera(), small);
  std::size_t i = 0;
  for (const BoardPose& pose : board_poses(3, 30.0 * degree, 3)) {
    cv::imwrite(file(base::text("board%zu.png", i)), small_renderer.picture(pose, i));
    ++i;
  }
  const Outcome run = calibrate("3x3");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("needed: more pictures or a larger board"));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

/// An EXIF segment that says that the camera was held upside down.
std::string upside_down(const std::string& jpeg) {
  using namespace std::string_literals;
  const std::string segment =
      "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0\0\0\0\0"s;
  const auto length = static_cast<char>(segment.size() + 2);
  return jpeg.substr(0, 2) + "\xFF\xE1\0"s + length + segment + jpeg.substr(2);
}

TEST_F(CameraFromBoard, OrientationThatACameraNotedChangesNothing) {
  write_tilted_boards(".jpg");
  ASSERT_EQ(calibrate().exit_code, 0);
  const std::string without = file_text(out());
  for (const char* name : {"board0.jpg", "board2.jpg", "board4.jpg"}) {
    write_text(file(name), upside_down(file_text(file(name))));
  }
  ASSERT_EQ(cv::imread(file("board0.jpg"), cv::IMREAD_GRAYSCALE).at<std::uint8_t>(0, 0),
            cv::imread(file("board0.jpg"), cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION)
                .at<std::uint8_t>(479, 639));
  ASSERT_EQ(calibrate().exit_code, 0);
  EXPECT_EQ(file_text(out()), without);
}

TEST_F(CameraFromBoard, OddPicturesAreNamedAndLeftOut) {
  write_tilted_boards();
  ASSERT_EQ(calibrate().exit_code, 0);
  const std::string without = file_text(out());
  cv::Mat wider;
  cv::copyMakeBorder(tilted_boards()[0], wider, 0, 1, 0, 1, cv::BORDER_REPLICATE);
  cv::imwrite(file("a first.png"), wider);
  write_cut(file("board1.png"), file("cut.png"), 5000);
  const Outcome run = calibrate();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err,
              HasSubstr("not used: " + file("a first.png") + ": is 641x481, most are 640x480"));
  EXPECT_THAT(run.err, HasSubstr("not used: " + file("cut.png") + ": the picture ends early"));
  EXPECT_EQ(file_text(out()), without);
}

TEST_F(CameraFromBoard, PictureThatFitsFarWorseIsNamedAndLeftOut) {
  write_tilted_boards();
  ASSERT_EQ(calibrate().exit_code, 0);
  const std::string without = file_text(out());
  cv::Mat narrower = tilted_boards()[3].clone();
  cv::resize(tilted_boards()[3], narrower(cv::Rect(0, 0, 600, 480)), {600, 480}, 0.0, 0.0,
             cv::INTER_AREA);
  cv::imwrite(file("squeezed.png"), narrower);
  const Outcome run = calibrate();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("not used: " + file("squeezed.png") + ": fits far worse"));
  EXPECT_EQ(file_text(out()), without);
}

TEST_F(CameraFromBoard, EqualPicturesCountOnceWhichIsTold) {
  write_tilted_boards();
  ASSERT_EQ(calibrate().exit_code, 0);
  const std::string without = file_text(out());
  std::filesystem::copy(file("board2.png"), file("copy.png"));
  const Outcome run = calibrate();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("not used: " + file("copy.png") + ": has the board where " +
                                 file("board2.png") + " has it"));
  EXPECT_EQ(file_text(out()), without);
}

TEST_F(CameraFromBoard, SixEqualPicturesAreWorthOne) {
  const BoardPose tilted{.middle_m = {0.02, -0.01, 0.4}, .turn_rad = {0.4, 0.5, 0.0}};
  for (int i = 0; i < 6; ++i)
    cv::imwrite(file(base::text("board%d.png", i)), renderer().picture(tilted, 1));
  const Outcome run = calibrate();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("warning: the board is seen in 1 place only"));
  const settings::Settings found = read_back();
  const double sigma_px = found.rig.uncertainty.focal_sigma_px;
  EXPECT_GT(sigma_px, 1.0) << "no such picture alone tells it to 0.2 %";
  EXPECT_NEAR(found.rig.camera.focal_px.x(), 540.0, 3.0 * sigma_px);
}

TEST_F(CameraFromBoard, BoardOfAnotherSizeIsSuggested) {
  // Two pictures: OpenCV takes seconds to be sure that a board is in none.
  for (std::size_t i = 0; i < 2; ++i)
    cv::imwrite(file(base::text("board%zu.png", i)), tilted_boards()[i]);
  const Outcome run = calibrate("10x7");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--board 10x7: not found in any of 2 pictures; 9x6 is found in 2: "
                                 "--board counts inner corners"));
}

TEST_F(CameraFromBoard, PicturesLargerThanGazedTakesAreScaled) {
  for (std::size_t i = 0; i < tilted_boards().size(); ++i) {
    cv::Mat large;
    cv::resize(tilted_boards()[i], large, {2720, 2040}, 0.0, 0.0, cv::INTER_CUBIC);
    cv::imwrite(file(base::text("board%zu.png", i)), large);
  }
  const Outcome run = calibrate();
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the pictures are 2720x2040, which gazed does not take: the "
                                 "calibration is written for 640x480"));
  const geometry::CameraModel camera = read_back().rig.camera;
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_NEAR(camera.focal_px.x(), 540.0, 6.0);
  EXPECT_NEAR(camera.centre_px.x(), 330.0, 4.0);
}

TEST(CalibrationReadBack, WhatGazedRefusesIsNotWritten) {
  settings::Settings settings = settings::default_settings();
  EXPECT_NO_THROW(check_read_back(settings));
  settings.rig.uncertainty.focal_sigma_px = std::nan("");
  EXPECT_THROW(check_read_back(settings), std::invalid_argument);
  settings = settings::default_settings();
  settings.rig.camera.focal_px.x() *= -1.0;
  EXPECT_THAT([&] { check_read_back(settings); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("camera.focal_px"), HasSubstr("yaw is positive left"))));
}

}  // namespace
}  // namespace gazed::lab::calibration::camera_command_test
