// The chain that the solver differentiates is the one that gazed uses.
#include "agent/lab/calibration/chain.hpp"

#include <Eigen/Core>
#include <array>
#include <gmock/gmock.h>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::lab::calibration::chain_test {
namespace {

constexpr double rounding = 1e-12;

HeadModel some_head() {
  const geometry::Rig v6 = geometry::robot_profile("nao-v6")->rig;
  HeadModel model{.camera = v6.camera, .head = v6.head};
  model.camera.distortion = {-0.1, 0.05, 0.002, -0.001, 0.01};
  model.head.mount_rotation_rad = {0.03, -0.05, 0.02};
  model.head.mount_offset_m = {0.06, -0.003, 0.065};
  model.head.zero = {0.01, -0.02};
  return model;
}

TEST(Chain, CameraStandsWhereGazedPutsIt) {
  const HeadModel model = some_head();
  const Parameters parameters = parameters_of(model);
  for (const geometry::HeadAngles angles :
       {geometry::HeadAngles{0.0, 0.0}, geometry::HeadAngles{0.7, -0.3}}) {
    const std::array sensor = {angles.yaw_rad, angles.pitch_rad};
    const auto place = camera_place(parameters.data(), sensor.data());
    const geometry::Pose torso_from_cam = geometry::cam_from_torso(model.head, angles).inverse();
    EXPECT_LT((place.neck_from_cam - torso_from_cam.rotation).norm(), rounding);
    EXPECT_LT((place.centre_m + model.head.neck_offset_m - torso_from_cam.translation).norm(),
              rounding);
  }
}

TEST(Chain, LensSeesWhatGazedSees) {
  const HeadModel model = some_head();
  const Parameters parameters = parameters_of(model);
  const Eigen::Vector3d point(0.2, -0.15, 0.7);
  EXPECT_LT(
      (seen_at(parameters.data(), point) - geometry::project(model.camera, point).value()).norm(),
      1e-9);
}

TEST(Chain, ScaleAndAxisOffset) {
  HeadModel model = some_head();
  model.encoder_scale = {1.1, 0.9};
  model.axis_offset_m = {0.01, 0.0, 0.02};
  const std::array sensor = {0.5, 0.2};
  const auto place = camera_place(parameters_of(model).data(), sensor.data());
  HeadModel plain = some_head();
  plain.head.neck_offset_m.setZero();
  const geometry::Pose torso_from_cam =
      geometry::cam_from_torso(plain.head, {0.55, 0.18}).inverse();
  EXPECT_LT((place.neck_from_cam - torso_from_cam.rotation).norm(), rounding);
  // The offset turns with yaw, not with pitch.
  const Eigen::Vector3d offset = geometry::about_z(0.55 + 0.01) * model.axis_offset_m;
  EXPECT_LT((place.centre_m - torso_from_cam.translation - offset).norm(), rounding);
}

TEST(Chain, ListAndModelAreTheSame) {
  HeadModel model = some_head();
  model.encoder_scale = {1.1, 0.9};
  model.axis_offset_m = {0.01, 0.0, 0.02};
  const Parameters parameters = parameters_of(model);
  EXPECT_EQ(parameters_of(with_parameters(HeadModel{}, parameters)), parameters);
}

}  // namespace
}  // namespace gazed::lab::calibration::chain_test
