// The head of a simulated V6 whose camera sits wrong, from pictures of a chessboard.
#include <Eigen/Core>
#include <cstdio>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "agent/base/text.hpp"
#include "agent/lab/calibration/calibration_report.hpp"
#include "agent/lab/calibration/head_calibration.hpp"
#include "agent/settings/settings.hpp"

#include "robots.hpp"
#include "scratch.hpp"
#include "simulated_looks.hpp"
#include "swing.hpp"

namespace gazed::lab::calibration::board_test {
namespace {

// 10 x 8 squares of 15 mm, square to nothing, on a white wall.
const std::string board_scene = std::string(v6_like_mount_error) + R"(
[camera]
fps = 1.0
pixel_noise = 2.0
blur_sigma_px = 0.5
[joints]
encoder_step_rad = 0.00153
encoder_noise_rad = 0.0005
settling_error_rad = 0.02
[[plane]]
centre_m = [0.9, 0.0, 0.2]
size_m = [4.0, 3.0]
texture = { colour = [230, 230, 230] }
[[plane]]
centre_m = [0.55, 0.02, 0.16]
normal = [-1.0, 0.25, 0.35]
size_m = [0.18, 0.15]
texture = { colour = [240, 240, 240] }
[[plane]]
centre_m = [0.5499, 0.02, 0.16]
normal = [-1.0, 0.25, 0.35]
size_m = [0.15, 0.12]
texture = { pattern = "checker", colour = [235, 235, 235], colour_2 = [20, 20, 20], cell_m = 0.015 }
)";
const Chessboard board{.columns = 9, .rows = 7, .square_m = 0.015};

/// The camera was calibrated before, as the README says: the sigmas of such a calibration.
HeadBelief belief_with_camera() {
  HeadBelief belief = v6_belief();
  belief.model.camera.focal_px += Eigen::Vector2d(0.4, 0.3);
  belief.model.camera.centre_px += Eigen::Vector2d(-0.5, 0.7);
  belief.uncertainty.focal_sigma_px = 0.5;
  belief.uncertainty.centre_sigma_px = 1.0;
  return belief;
}

class FromBoard : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    looks_ = new SimulatedLooks(
        simulated_looks(board_scene, grid_of_looks(5, 0.22, GAZED_LOOK_ROWS, 0.16, 0.08)));
    result_ =
        new HeadCalibration(calibrate_on_board(belief_with_camera(), board, looks_->pictures));
    std::fputs(report_of(*result_).c_str(), stdout);
  }
  static void TearDownTestSuite() {
    delete result_;
    delete looks_;
  }
  static SimulatedLooks* looks_;
  static HeadCalibration* result_;
};
SimulatedLooks* FromBoard::looks_ = nullptr;
HeadCalibration* FromBoard::result_ = nullptr;

TEST_F(FromBoard, MountComesBack) {
  const geometry::HeadGeometry& truth = looks_->truth.head;
  const geometry::HeadGeometry& found = result_->after.head;
  // The sigmas of a calibrated robot: 3 mrad and 1 mm.
  EXPECT_LT((found.mount_rotation_rad - truth.mount_rotation_rad).cwiseAbs().maxCoeff(), 0.003);
  EXPECT_LT((found.mount_offset_m - truth.mount_offset_m).cwiseAbs().maxCoeff(), 0.001);
  const Eigen::Vector3d turn = 1e3 * (found.mount_rotation_rad - truth.mount_rotation_rad);
  const Eigen::Vector3d shift = 1e3 * (found.mount_offset_m - truth.mount_offset_m);
  std::printf("rotation off by %.2f %.2f %.2f mrad, offset by %.2f %.2f %.2f mm\n", turn.x(),
              turn.y(), turn.z(), shift.x(), shift.y(), shift.z());
}

TEST_F(FromBoard, FixedObjectStandsStill) {
  expect_little_swing(*looks_, *result_);
}

/// The same pictures through the program, from files.
TEST_F(FromBoard, FolderGivesTheSame) {
  const ScratchFolder folder;
  std::string rows = "utime_us,file,yaw_rad,pitch_rad\n";
  for (std::size_t i = 0; i < looks_->pictures.size(); ++i) {
    const HeadPicture& picture = looks_->pictures[i];
    const std::string name = base::text("%02zu.png", i);
    cv::imwrite((folder / name).string(), picture.grey);
    rows += base::text("%zu,%s,%.17g,%.17g\n", (i + 1) * 1'000'000, name.c_str(),
                       picture.measured.yaw_rad, picture.measured.pitch_rad);
  }
  write_text(folder / "frames.csv", rows);
  const geometry::CameraModel camera = belief_with_camera().model.camera;
  write_text(folder / "camera.toml",
             base::text("[camera]\nfocal_px = [%.17g, %.17g]\ncentre_px = [%.17g, %.17g]\n"
                        "[uncertainty]\nfocal_sigma_px = 0.5\ncentre_sigma_px = 1.0\n",
                        camera.focal_px.x(), camera.focal_px.y(), camera.centre_px.x(),
                        camera.centre_px.y()));
  const std::string out = folder / "robot.toml";
  const Outcome run =
      run_gazelab({"calibrate", folder.path().string(), "--board", "9x7", "--square", "0.015",
                   "--config", folder / "camera.toml", "--out", out});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const settings::Settings settings =
      settings::load_settings({.environment = {}, .file = out, .command_line = {}}, {});
  constexpr double last_digit = 1e-6;  // of the file, rounded
  EXPECT_LT((settings.head.geometry.mount_offset_m - result_->after.head.mount_offset_m).norm(),
            last_digit);
  EXPECT_LT(
      (settings.head.geometry.mount_rotation_rad - result_->after.head.mount_rotation_rad).norm(),
      last_digit);
  EXPECT_THAT(run.err, ::testing::HasSubstr("yaw zero"));
}

TEST_F(FromBoard, SquareBoardHasFourWaysUp) {
  EXPECT_THROW(static_cast<void>(calibrate_on_board(belief_with_camera(),
                                                    {.columns = 7, .rows = 7, .square_m = 0.015},
                                                    std::span(looks_->pictures).first(5))),
               std::invalid_argument);
}

TEST_F(FromBoard, BoardThatIsNotThere) {
  EXPECT_THROW(static_cast<void>(calibrate_on_board(belief_with_camera(),
                                                    {.columns = 20, .rows = 19, .square_m = 0.01},
                                                    std::span(looks_->pictures).first(5))),
               std::invalid_argument);
}

}  // namespace
}  // namespace gazed::lab::calibration::board_test
