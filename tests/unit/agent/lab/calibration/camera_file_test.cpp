// The calibration files of ROS, OpenCV and Kalibr, as those programs write them.
#include "agent/lab/calibration/camera_file.hpp"

#include <Eigen/Core>
#include <filesystem>
#include <gmock/gmock.h>
#include <stdexcept>
#include <string>

#include "agent/settings/settings.hpp"

#include "rendered_board.hpp"
#include "scratch.hpp"

namespace gazed::lab::calibration::camera_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr const char* ros = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [533.1, 0.0, 342.0, 0.0, 533.2, 233.8, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.28, 0.04, 0.001, -0.0001, 0.13]
)";

class CameraFileTest : public ::testing::Test {
 protected:
  geometry::CameraModel read(const std::string& text, const std::string& name = "camera.yaml") {
    write_text(scratch_ / name, text);
    return read_camera_file(scratch_ / name, believed_);
  }
  void expect_refusal(const std::string& text, const std::string& why) {
    EXPECT_THAT([&] { static_cast<void>(read(text)); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
  }
  static std::string with(std::string text, const std::string& part, const std::string& other) {
    return text.replace(text.find(part), part.size(), other);
  }

  ScratchFolder scratch_;
  geometry::CameraModel believed_{.width_px = 320, .height_px = 240};
};

TEST_F(CameraFileTest, RosCameraInfo) {
  const geometry::CameraModel camera = read(ros);
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.focal_px, Eigen::Vector2d(533.1, 533.2));
  EXPECT_EQ(camera.centre_px, Eigen::Vector2d(342.0, 233.8));
  EXPECT_THAT(camera.distortion, ElementsAre(-0.28, 0.04, 0.001, -0.0001, 0.13));
}

TEST_F(CameraFileTest, OpenCvYaml) {
  const geometry::CameraModel camera = read(R"(%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.331e+02, 0., 3.42e+02, 0., 5.332e+02, 2.338e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.8e-01, 4.0e-02, 1.0e-03, -1.0e-04, 1.3e-01 ]
)");
  EXPECT_EQ(camera.focal_px, Eigen::Vector2d(533.1, 533.2));
  EXPECT_EQ(camera.distortion[4], 0.13);
}

TEST_F(CameraFileTest, KalibrCamchain) {
  const geometry::CameraModel camera = read(R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.04, 0.001, -0.0001]
  distortion_model: radtan
  intrinsics: [533.1, 533.2, 342.0, 233.8]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, 0.1]
  - [0.0, 1.0, 0.0, 0.0]
)");
  EXPECT_EQ(camera.width_px, 752);
  EXPECT_EQ(camera.centre_px, Eigen::Vector2d(342.0, 233.8));
  EXPECT_THAT(camera.distortion, ElementsAre(-0.28, 0.04, 0.001, -0.0001, 0.0));
}

TEST_F(CameraFileTest, WhatIsWrittenIsReadBack) {
  const geometry::CameraModel camera = rendered_camera();
  for (const std::string name : {"out.yaml", "out.xml"}) {
    const geometry::CameraModel back = read(camera_text(camera, *camera_format_of(name)), name);
    EXPECT_EQ(back.width_px, camera.width_px) << name;
    EXPECT_EQ(back.focal_px, camera.focal_px) << name;
    EXPECT_EQ(back.centre_px, camera.centre_px) << name;
    EXPECT_EQ(back.distortion, camera.distortion) << name;
  }
  EXPECT_FALSE(camera_format_of("out.toml"));
}

TEST_F(CameraFileTest, FileWithoutSizeIsOfTheCameraBelieved) {
  const geometry::CameraModel camera =
      read("M1: {data: [500, 0, 150, 0, 500, 110, 0, 0, 1]}\nD1: {data: [0.1, 0, 0, 0]}\n");
  EXPECT_EQ(camera.width_px, 320);
  EXPECT_EQ(camera.distortion[0], 0.1);
}

TEST_F(CameraFileTest, OtherLensesAreRefused) {
  expect_refusal(with(ros, "plumb_bob", "equidistant"), "the lens model equidistant found");
  const std::string rational =
      with(with(ros, "plumb_bob", "rational_polynomial"), "0.13]", "0.13, 0.2, 0.0, 0.0]");
  expect_refusal(rational, "distortion of 8 numbers found; allowed: 4 or 5");
  EXPECT_NO_THROW(static_cast<void>(read(with(rational, "0.2, 0.0", "0.0, 0.0"))));
}

TEST_F(CameraFileTest, WhatIsNoCalibrationIsNamed) {
  expect_refusal("", "no key found");
  expect_refusal("a: [1, 2", "allowed: ROS's or OpenCV's YAML");
  expect_refusal(with(ros, "533.1", "-533.1"), "a focal length that is not above 0");
  expect_refusal(with(ros, "533.1, ", ""), "a camera of 8 numbers found");
  expect_refusal("<?xml version=\"1.0\"?><opencv_storage><a>", "OpenCV's XML");
}

TEST_F(CameraFileTest, ProgramMakesGazedsOfIt) {
  write_text(scratch_ / "ost.yaml", ros);
  const std::string out = scratch_ / "camera.toml";
  const Outcome run = run_gazelab(
      {"calibrate", "--camera-file", scratch_ / "ost.yaml", "--robot", "nao-v4", "--out", out});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const settings::Settings settings =
      settings::load_settings({.environment = {}, .file = out, .command_line = {}}, {});
  EXPECT_EQ(settings.robot, "nao-v4");
  EXPECT_EQ(settings.rig.camera.focal_px.y(), 533.2);
}

}  // namespace
}  // namespace gazed::lab::calibration::camera_file_test
