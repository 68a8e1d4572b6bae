// The head of a simulated V6 whose camera sits wrong, from pictures of a room that nobody measured.
#include <Eigen/Core>
#include <cstdio>
#include <exception>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/calibration/calibration_report.hpp"
#include "agent/lab/calibration/head_calibration.hpp"

#include "robots.hpp"
#include "simulated_looks.hpp"

namespace gazed::lab::calibration::scene_test {
namespace {

// A papered wall, a picture on it and two boxes before it.
const std::string textured_scene = std::string(v6_like_mount_error) + R"(
[camera]
fps = 1.0
pixel_noise = 2.0
blur_sigma_px = 0.5
[joints]
encoder_step_rad = 0.00153
encoder_noise_rad = 0.0005
settling_error_rad = 0.02
[[plane]]
centre_m = [1.3, 0.0, 0.2]
size_m = [6.0, 4.0]
texture = { pattern = "natural", colour = [150, 140, 130], contrast = 35.0, tile_m = 1.5 }
[[plane]]
centre_m = [0.8, 0.25, 0.1]
normal = [-1.0, -0.4, 0.2]
size_m = [0.4, 0.5]
texture = { pattern = "natural", colour = [120, 140, 160], contrast = 35.0, tile_m = 0.8, seed = 3 }
[[plane]]
centre_m = [0.7, -0.25, 0.2]
normal = [-1.0, 0.3, 0.0]
size_m = [0.35, 0.4]
texture = { pattern = "natural", colour = [160, 130, 120], contrast = 35.0, tile_m = 0.7, seed = 4 }
)";

class FromScene : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    looks_ = new SimulatedLooks(
        simulated_looks(textured_scene, grid_of_looks(5, 0.6, GAZED_LOOK_ROWS, 0.3, 0.0)));
    result_ = new HeadCalibration(calibrate_on_scene(v6_belief(), looks_->pictures));
    std::fputs(report_of(*result_).c_str(), stdout);
  }
  static void TearDownTestSuite() {
    delete result_;
    delete looks_;
  }
  static SimulatedLooks* looks_;
  static HeadCalibration* result_;
};
SimulatedLooks* FromScene::looks_ = nullptr;
HeadCalibration* FromScene::result_ = nullptr;

TEST_F(FromScene, MountRotationComesBack) {
  const Eigen::Vector3d off =
      result_->after.head.mount_rotation_rad - looks_->truth.head.mount_rotation_rad;
  std::printf("rotation off by %.2f %.2f %.2f mrad\n", 1e3 * off.x(), 1e3 * off.y(), 1e3 * off.z());
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 0.003);  // the sigma of a calibrated robot
}

TEST_F(FromScene, LengthOfTheArmIsNamedUnobservable) {
  EXPECT_THAT(report_of(*result_), ::testing::HasSubstr("the arm's length"));
}

TEST_F(FromScene, PicturesThatDoNotTurnWithTheHead) {
  std::vector<HeadPicture> pictures;
  for (std::size_t i = 0; i < 6; ++i) {
    pictures.push_back(looks_->pictures[7]);
    pictures.back().measured = {0.08 * static_cast<double>(i), i % 2 == 0 ? 0.0 : 0.15};
  }
  EXPECT_THROW(static_cast<void>(calibrate_on_scene(v6_belief(), pictures)), std::exception);
}

TEST_F(FromScene, HeadThatTurnsInYawOnly) {
  std::vector<HeadPicture> pictures(looks_->pictures.begin(), looks_->pictures.begin() + 5);
  EXPECT_THROW(static_cast<void>(calibrate_on_scene(v6_belief(), pictures)), std::invalid_argument);
}

TEST_F(FromScene, FixedObjectStandsStill) {
  expect_little_swing(*looks_, *result_);
}

}  // namespace
}  // namespace gazed::lab::calibration::scene_test
