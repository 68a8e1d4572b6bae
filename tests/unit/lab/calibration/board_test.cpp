// The head of a simulated V6 whose camera sits wrong, from pictures of a chessboard.
#include <cstdio>
#include <gmock/gmock.h>

#include "agent/lab/calibration/calibration_report.hpp"
#include "agent/lab/calibration/head_calibration.hpp"

#include "robots.hpp"
#include "simulated_looks.hpp"
#include "swing.hpp"

namespace gazed {
namespace {

// 10 x 8 squares of 15 mm, square to nothing, on a white wall.
const std::string board_scene = std::string(v6_like_mount_error) + R"(
[camera]
fps = 2.0
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

class FromBoard : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    looks_ = new SimulatedLooks(simulated_looks(board_scene, grid_of_looks(5, 0.32, 4, 0.26, 0.0)));
    result_ = new HeadCalibration(calibrate_on_board(v6_belief(), board, looks_->pictures));
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
  const HeadGeometry& truth = looks_->truth.head;
  const HeadGeometry& found = result_->after.head;
  // Issue 5: 3 mrad and 1 mm.
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

}  // namespace
}  // namespace gazed
