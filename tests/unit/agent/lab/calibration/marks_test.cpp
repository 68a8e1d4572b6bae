// A head calibrated from measured marks: made ones, and the readings of a real pan-tilt camera.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <numbers>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/calibration/calibrated_settings.hpp"
#include "agent/lab/calibration/calibration_report.hpp"
#include "agent/lab/calibration/chain.hpp"
#include "agent/lab/calibration/head_calibration.hpp"

#include "robots.hpp"
#include "scratch.hpp"

namespace gazed::lab::calibration::marks_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What a head reads without noise at marks on a wall, 0.6 m away.
std::vector<MarkReading> perfect_readings(const HeadModel& truth) {
  std::vector<MarkReading> readings;
  const Parameters parameters = parameters_of(truth);
  for (const geometry::HeadAngles look : grid_of_looks(7, 0.6, 5, 0.3, 0.0)) {
    const std::array sensor = {look.yaw_rad, look.pitch_rad};
    const auto place = camera_place(parameters.data(), sensor.data());
    for (int i = 0; i < 9; ++i) {
      const Eigen::Vector3d mark(0.6 - 0.05 * (i % 2), 0.15 * (i % 3 - 1),
                                 0.2 + 0.12 * (i / 3 - 1));
      const Eigen::Vector3d in_cam =
          place.neck_from_cam.transpose() * (mark - truth.head.neck_offset_m - place.centre_m);
      if (in_cam.z() <= 0.0) continue;
      const geometry::Pixel pixel = seen_at(parameters.data(), in_cam);
      if (truth.camera.contains(pixel)) readings.push_back({look, pixel, mark});
    }
  }
  return readings;
}

constexpr double perfect = 1e-4;  // radians and metres: the priors pull a little

TEST(Marks, HeadWithAnOffsetBetweenItsAxes) {
  HeadBelief belief = v6_belief();
  HeadModel truth = belief.model;
  truth.head.mount_rotation_rad = {0.03, -0.05, 0.01};
  truth.head.mount_offset_m += Eigen::Vector3d(0.004, -0.003, 0.002);
  truth.axis_offset_m = {0.012, 0.0, 0.0};
  belief.axis_offset_estimated = true;
  const HeadCalibration result = calibrate_on_marks(belief, perfect_readings(truth));
  EXPECT_LT(result.fit.after.measured_px, 0.01);
  EXPECT_NEAR(result.after.axis_offset_m.x(), 0.012, perfect);
  const std::string report = report_of(result);
  EXPECT_THAT(report, HasSubstr("head.zero_rad yaw): turns the whole world"));
  EXPECT_THAT(report, HasSubstr("axis offset y against camera.mount_offset_m y"));
  EXPECT_THAT(report, HasSubstr("axis offset z"));  // the marks' height takes it up
}

TEST(Marks, AxisOffsetThatIsGivenIsHeld) {
  HeadBelief belief = v6_belief();
  belief.model.axis_offset_m = {0.012, 0.0, 0.022};
  HeadModel truth = belief.model;
  truth.head.mount_rotation_rad = {0.03, -0.05, 0.01};
  const HeadCalibration result = calibrate_on_marks(belief, perfect_readings(truth));
  EXPECT_LT(result.fit.after.measured_px, 0.01);
  EXPECT_EQ(result.after.axis_offset_m, belief.model.axis_offset_m);
  EXPECT_LT((result.after.head.mount_rotation_rad - truth.head.mount_rotation_rad).norm(), perfect);
}

/// How far the file's camera is from the true one, at most, over the yaws and at one pitch.
double camera_error_m(const geometry::HeadGeometry& file, const HeadModel& truth,
                      double pitch_rad) {
  double greatest_m = 0.0;
  const Parameters parameters = parameters_of(truth);
  for (const double yaw_rad : {-1.5, -0.6, 0.0, 0.9}) {
    const std::array sensor = {yaw_rad, pitch_rad};
    const Eigen::Vector3d centre_m =
        truth.head.neck_offset_m + camera_place(parameters.data(), sensor.data()).centre_m;
    const Eigen::Vector3d believed_m =
        geometry::origin(geometry::cam_from_torso(file, {yaw_rad, pitch_rad}));
    greatest_m = std::max(greatest_m, (believed_m - centre_m).norm());
  }
  return greatest_m;
}

// gazed takes axes that meet: its file must say how wrong that is.
TEST(Marks, AxisOffsetForwardWidensTheFile) {
  HeadBelief belief = v6_belief();
  belief.model.axis_offset_m = {0.04, 0.0, 0.02};
  const HeadCalibration result = calibrate_on_marks(belief, perfect_readings(belief.model));
  const settings::Settings file = calibrated_settings(settings::default_settings(), result);
  EXPECT_LT(camera_error_m(file.rig.head, belief.model, 0.0), perfect);
  for (const double pitch_rad : {-0.67, -0.3, 0.2, 0.51}) {
    const double error_m = camera_error_m(file.rig.head, belief.model, pitch_rad);
    EXPECT_NEAR(error_m, 0.04 * 2.0 * std::abs(std::sin(pitch_rad / 2.0)), perfect);
    EXPECT_LT(error_m, file.rig.uncertainty.mount_offset_sigma_m);
  }
  EXPECT_GE(file.rig.uncertainty.mount_offset_sigma_m, 0.04);
  EXPECT_THAT(report_of(result),
              HasSubstr("warning: the axis offset's x, 40.00 mm, is right in mount_offset_m at "
                        "pitch 0 only: at 0.5 rad gazed has the camera 19.79 mm off. "
                        "mount_offset_sigma_m is larger by 40.00 mm for that"));
}

TEST(Marks, AxisOffsetAcrossAndUpwardsIsExactInTheFile) {
  HeadBelief belief = v6_belief();
  belief.model.axis_offset_m = {0.0, 0.03, 0.02};
  const HeadCalibration result = calibrate_on_marks(belief, perfect_readings(belief.model));
  const settings::Settings file = calibrated_settings(settings::default_settings(), result);
  for (const double pitch_rad : {-0.67, 0.0, 0.51}) {
    EXPECT_LT(camera_error_m(file.rig.head, belief.model, pitch_rad), perfect);
  }
  EXPECT_LT(file.rig.uncertainty.mount_offset_sigma_m, 0.001);
  EXPECT_THAT(report_of(result), HasSubstr("its z (0.02000 m) in neck_offset_m"));
  EXPECT_THAT(report_of(result), Not(HasSubstr("warning")));
}

TEST(Marks, InTheTorsoFrameTheYawZeroIsSeen) {
  HeadBelief belief = v6_belief();
  belief.marks_in_torso = true;
  HeadModel truth = belief.model;
  truth.head.zero = {0.008, 0.0};
  truth.head.mount_rotation_rad += Eigen::Vector3d(0.01, -0.02, 0.01);
  const HeadCalibration result = calibrate_on_marks(belief, perfect_readings(truth));
  EXPECT_NEAR(result.after.head.zero.yaw_rad, 0.008, perfect);
  EXPECT_THAT(report_of(result), Not(HasSubstr("turns the whole world")));
  EXPECT_THAT(report_of(result), HasSubstr("the mount's pitch and offset take it up"));
}

TEST(Marks, EncoderThatCountsWronglyIsAWarning) {
  const HeadBelief belief = v6_belief();
  HeadModel truth = belief.model;
  truth.encoder_scale = {0.94, 1.0};
  const HeadCalibration result = calibrate_on_marks(belief, perfect_readings(truth));
  EXPECT_NEAR(result.encoder_scale.x(), 0.94, perfect);
  EXPECT_TRUE(result.scale_is_wrong[0]);
  EXPECT_FALSE(result.scale_is_wrong[1]);
  EXPECT_THAT(report_of(result), HasSubstr("the head turns 6.00 % less in yaw"));
  EXPECT_EQ(scale_condition(result), "yaw angles are multiplied by 0.94000");
}

// A wrong sign of x: the first guess of the geometry has nothing before the camera to start from.
TEST(Marks, AllBehindTheCamera) {
  HeadBelief belief = v6_belief();
  belief.marks_in_torso = true;
  std::vector<MarkReading> readings = perfect_readings(belief.model);
  for (MarkReading& reading : readings) reading.mark_m.x() = -1.5;
  try {
    static_cast<void>(calibrate_on_marks(belief, readings));
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("in front of the camera; in the torso's frame x is forward"));
  }
}

TEST(Marks, TooFewReadings) {
  const auto readings = perfect_readings(v6_belief().model);
  EXPECT_THROW(static_cast<void>(calibrate_on_marks(v6_belief(), std::span(readings).first(3))),
               std::invalid_argument);
}

// Dai, Xiong, Li (2011): 71 readings of 8 marks on a floor by a pan-tilt camera, 45 to 60 cm above
// it; nine parameters fitted to them leave 5.7 px rms.
TEST(Marks, RealPanTiltCamera) {
  const std::string file = GAZED_SHARED "/data/pan_tilt/calibration_data.log";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  std::ifstream stream(file);
  std::vector<MarkReading> readings;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream fields(line);
    double pan_deg = 0, tilt_deg = 0, u = 0, v = 0, x_cm = 0, y_cm = 0;
    if (!(fields >> pan_deg >> tilt_deg >> u >> v >> x_cm >> y_cm)) continue;
    constexpr double rad = std::numbers::pi / 180.0;
    // Pan is positive to the right; pixels are of half size; the marks lie on the floor.
    readings.push_back(
        {{-pan_deg * rad, tilt_deg * rad}, {2 * u, 2 * v}, {0.01 * x_cm, 0.01 * y_cm, 0.0}});
  }
  ASSERT_EQ(readings.size(), 71U);
  HeadBelief belief;  // intrinsics: the data's README; of the mount nothing but its size
  belief.model.camera.focal_px = {471.34, 472.98};
  belief.model.camera.centre_px = {301.39, 267.57};
  belief.uncertainty.focal_sigma_px = 5.0;
  belief.uncertainty.centre_sigma_px = 5.0;
  belief.uncertainty.zero_sigma_rad = 0.1;
  belief.axis_offset_estimated = true;
  const HeadCalibration result = calibrate_on_marks(belief, readings);
  std::fputs(report_of(result).c_str(), stdout);
  EXPECT_EQ(result.fit.sightings_used, 71U);
  EXPECT_LE(result.fit.after.measured_px, 5.8);
  EXPECT_LT(result.after.head.mount_offset_m.norm(), 0.1);
  EXPECT_LT(result.after.axis_offset_m.norm(), 0.05);
  EXPECT_LT(result.after.head.mount_rotation_rad.cwiseAbs().maxCoeff(), 0.15);
  EXPECT_GT(result.neck_in_pattern_m->z(), 0.40);
  EXPECT_LT(result.neck_in_pattern_m->z(), 0.60);
}

constexpr const char* header = "yaw_rad,pitch_rad,x_px,y_px,X_m,Y_m,Z_m\n";

TEST(MarksCsv, IsRead) {
  const ScratchFolder folder;
  write_text(folder / "marks.csv", std::string(header) + "0.1,-0.2,3,4.5,0.5,-0.25,1e-1\r\n\n");
  const auto readings = read_marks_csv(folder / "marks.csv");
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].measured, (geometry::HeadAngles{0.1, -0.2}));
  EXPECT_EQ(readings[0].pixel, geometry::Pixel(3, 4.5));
  EXPECT_EQ(readings[0].mark_m, Eigen::Vector3d(0.5, -0.25, 0.1));
}

TEST(MarksCsv, ErrorsNameTheLine) {
  const ScratchFolder folder;
  const auto error_of = [&](const std::string& text) -> std::string {
    write_text(folder / "marks.csv", text);
    try {
      static_cast<void>(read_marks_csv(folder / "marks.csv"));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(error_of(""), HasSubstr("is empty, expected the header"));
  EXPECT_THAT(error_of("yaw,pitch\n"), HasSubstr("marks.csv:1: the header is 'yaw,pitch'"));
  EXPECT_THAT(error_of(header), HasSubstr("no readings"));
  EXPECT_THAT(error_of(std::string(header) + "0,0,1,2,3\n"), HasSubstr("marks.csv:2: '0,0,1,2,3'"));
  EXPECT_THAT(error_of(std::string(header) + "0,0,1,2,0.5,nan,1\n"), HasSubstr("Y_m is 'nan'"));
  EXPECT_THAT(error_of(std::string(header) + "20,0,1,2,0.5,0,1\n"),
              HasSubstr("yaw_rad is '20', expected an angle in radians between -pi and pi"));
  EXPECT_THAT(error_of(std::string(header) + "0,0,1,2,500,0,1\n"), HasSubstr("X_m is '500'"));
}

}  // namespace
}  // namespace gazed::lab::calibration::marks_test
