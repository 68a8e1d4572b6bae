#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include "drivers/sim/sim_robot.hpp"

#include "tests/benchmarks/accuracy_rows.hpp"
#include "tests/benchmarks/closed_loop.hpp"

namespace gazed::benchmarks::accuracy_test {
namespace {

const Row& row_named(std::string_view name) {
  for (const Row& row : accuracy_rows())
    if (row.name == name) return row;
  throw std::invalid_argument("no such row");
}

const sim::PlacedPlane& object_of(const Trial& trial) {
  return trial.scene.planes.back();
}

bool needs_photographs(const Row& row) {
  return row.room == Room::photographs;
}

TEST(AccuracyRows, HaveNamesAndSeedsOfTheirOwn) {
  std::set<std::string_view> names;
  std::set<std::uint64_t> seeds;
  for (const Row& row : accuracy_rows()) {
    names.insert(row.name);
    seeds.insert(row.seeds);
  }
  EXPECT_EQ(names.size(), accuracy_rows().size());
  EXPECT_EQ(seeds.size(), accuracy_rows().size());
}

TEST(AccuracyRows, TheSameTrialAgainAndAnotherRobotEachTime) {
  const Row& row = row_named("textured_03");
  EXPECT_EQ(draw_trial(row, 5).scene.robot.focal_px, draw_trial(row, 5).scene.robot.focal_px);
  EXPECT_EQ(object_of(draw_trial(row, 5)).centre_m, object_of(draw_trial(row, 5)).centre_m);
  EXPECT_NE(draw_trial(row, 5).scene.robot.focal_px, draw_trial(row, 6).scene.robot.focal_px);
  EXPECT_NE(draw_trial(row, 5).scene.robot.focal_px,
            draw_trial(row_named("textured_10"), 5).scene.robot.focal_px);
}

TEST(AccuracyRows, RobotsErrAsMuchAsTheAgentIsTold) {
  constexpr int robots = 400;
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  double focal = 0.0, offset = 0.0, rotation = 0.0, zero = 0.0;
  for (std::uint64_t i = 0; i < robots; ++i) {
    const Trial trial = draw_trial(row_named("blank_03"), i);
    const sim::RobotTruth& robot = trial.scene.robot;
    EXPECT_EQ((*robot.focal_px)[0], (*robot.focal_px)[1]);
    focal += std::pow((*robot.focal_px)[0] - profile.rig.camera.focal_px.x(), 2);
    offset += std::pow((*robot.mount_offset_m)[2] - profile.rig.head.mount_offset_m.z(), 2);
    rotation +=
        std::pow((*robot.mount_rotation_rad)[1] - profile.rig.head.mount_rotation_rad.y(), 2);
    zero += std::pow((*robot.zero_rad)[1], 2);
    EXPECT_EQ(trial.settings.rig.camera.focal_px, profile.rig.camera.focal_px);
    EXPECT_EQ(trial.settings.rig.uncertainty.encoder_sigma_rad,
              trial.scene.joints.encoder_sigma_rad);
  }
  // Four standard deviations of a standard deviation of so many values: 1 / sqrt(2 n).
  constexpr double tolerance = 4.0 / 28.3;
  const geometry::Uncertainty told = draw_trial(row_named("blank_03"), 0).settings.rig.uncertainty;
  EXPECT_NEAR(std::sqrt(focal / robots) / told.focal_sigma_px, 1.0, tolerance);
  EXPECT_NEAR(std::sqrt(offset / robots) / told.mount_offset_sigma_m, 1.0, tolerance);
  EXPECT_NEAR(std::sqrt(rotation / robots) / told.mount_rotation_sigma_rad, 1.0, tolerance);
  EXPECT_NEAR(std::sqrt(zero / robots) / told.zero_sigma_rad, 1.0, tolerance);
}

TEST(AccuracyRows, RealRobotsCreepAndRollTheirShutters) {
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  const Trial trial = draw_trial(row_named("real_03"), 3);
  EXPECT_EQ(trial.scene.joints.settle_time_constant_s, 0.08);
  EXPECT_EQ(trial.scene.joints.velocity, sim::Velocity::none);
  EXPECT_EQ(trial.scene.camera.readout_s, profile.readout_s);
  EXPECT_EQ(trial.settings.cycle.camera.readout_s, profile.readout_s);
  EXPECT_EQ(trial.scene.camera.format, base::PixelFormat::yuyv);
  EXPECT_EQ(draw_trial(row_named("textured_03"), 3).scene.camera.readout_s, 0.0);
}

TEST(AccuracyRows, NobodyCalibratedTheUncalibrated) {
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  const Trial trial = draw_trial(row_named("pair_real_03"), 3);
  EXPECT_EQ(trial.settings.rig.uncertainty.focal_sigma_px, profile.rig.uncertainty.focal_sigma_px);
  EXPECT_EQ(trial.settings.cycle.locate.looks, 2);
  EXPECT_GT(std::abs((*trial.scene.robot.focal_px)[0] - profile.rig.camera.focal_px.x()), 0.5);
}

TEST(AccuracyRows, NothingHidesARealObjectFromCameraOneNorFromATurnedHead) {
  const Row& row = row_named("real_03");
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Trial trial = draw_trial(row, i);
    const sim::TrueRobot robot = sim::true_robot(trial.scene, *geometry::robot_profile("nao-v6"));
    const sim::World world = sim::make_world(trial.scene, 0, robot);
    const Eigen::Vector3d centre_m = object_of(trial).centre_m;
    for (const geometry::HeadAngles turn :
         {geometry::HeadAngles{}, {0.3, 0.0}, {-0.3, 0.0}, {0.0, 0.2}, {0.0, -0.2}}) {
      const geometry::Pose cam = geometry::cam_from_torso(robot.head, turn);
      const std::optional<geometry::Pixel> pixel = geometry::project(robot.camera, cam * centre_m);
      if (!pixel || !robot.camera.contains(*pixel, 0.0)) continue;
      const std::optional<sim::Hit> hit = sim::hit(world, robot.camera, cam, *pixel);
      ASSERT_TRUE(hit);
      EXPECT_TRUE(hit->target) << "trial " << i << ", yaw " << turn.yaw_rad;
      EXPECT_NEAR(hit->range_m, (cam * centre_m).norm(), 1e-6);
    }
  }
}

/// The share of the object's outline, well inside it, that a turned head sees.
double seen_share(const Trial& trial, const geometry::HeadAngles& turn) {
  const sim::TrueRobot robot = sim::true_robot(trial.scene, *geometry::robot_profile("nao-v6"));
  const sim::World world = sim::make_world(trial.scene, 0, robot);
  const geometry::Pose cam = geometry::cam_from_torso(robot.head, turn);
  const sim::PlacedPlane& object = object_of(trial);
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(object.normal).normalized();
  const Eigen::Vector3d up = object.normal.normalized().cross(across);
  constexpr int points = 64;
  int seen = 0;
  for (int i = 0; i < points; ++i) {
    const double angle = 6.2832 * i / points,
                 radius_m =
                     0.48 * std::min(object.appearance.size_m[0], object.appearance.size_m[1]);
    const Eigen::Vector3d at_m =
        object.centre_m + radius_m * std::cos(angle) * across + radius_m * std::sin(angle) * up;
    const std::optional<geometry::Pixel> pixel = geometry::project(robot.camera, cam * at_m);
    if (!pixel) continue;
    const std::optional<sim::Hit> hit = sim::hit(world, robot.camera, cam, *pixel);
    seen += hit && std::abs(hit->range_m - (cam * at_m).norm()) < 1e-6 ? 1 : 0;
  }
  return static_cast<double>(seen) / points;
}

TEST(AccuracyRows, AnEdgeHidesPartOfTheObjectInSomeLooksOnly) {
  int hidden = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Trial trial = draw_trial(row_named("edge"), i);
    EXPECT_GT(seen_share(trial, {}), 0.9) << i;
    double least = 1.0;
    for (const geometry::HeadAngles turn :
         {geometry::HeadAngles{0.3, 0.0}, {-0.3, 0.0}, {0.3, 0.2}, {-0.3, 0.2}})
      least = std::min(least, seen_share(trial, turn));
    hidden += least < 0.9 ? 1 : 0;
  }
  EXPECT_GT(hidden, 10);
}

TEST(AccuracyRows, TwinsAreTheSameAndBothInView) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Trial trial = draw_trial(row_named("twins"), i);
    const sim::TrueRobot robot = sim::true_robot(trial.scene, *geometry::robot_profile("nao-v6"));
    const geometry::Pose cam1 = geometry::cam_from_torso(robot.head, geometry::HeadAngles{});
    const sim::PlacedPlane& object = object_of(trial);
    const sim::PlacedPlane& twin = trial.scene.planes[trial.scene.planes.size() - 2];
    EXPECT_EQ(twin.appearance.texture.colour, object.appearance.texture.colour);
    EXPECT_EQ(twin.appearance.size_m, object.appearance.size_m);
    EXPECT_GT((twin.centre_m - object.centre_m).norm(), 1.29 * object.appearance.size_m[0]);
    EXPECT_TRUE(robot.camera.contains(*geometry::project(robot.camera, cam1 * twin.centre_m), 0.0));
  }
}

TEST(AccuracyRows, OtherImageSizesHaveTheSameLens) {
  const Trial trial = draw_trial(row_named("size320_03"), 2);
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  const sim::TrueRobot robot = sim::true_robot(trial.scene, profile);
  EXPECT_EQ(robot.camera.width_px, 320);
  EXPECT_EQ(robot.camera.height_px, 240);
  EXPECT_EQ(trial.settings.rig.camera.width_px, 320);
  EXPECT_EQ(trial.settings.rig.camera.focal_px.x(), 0.5 * profile.rig.camera.focal_px.x());
  EXPECT_NEAR(robot.camera.focal_px.x(), trial.settings.rig.camera.focal_px.x(), 2.0);
  EXPECT_NEAR(robot.camera.centre_px.y(), trial.settings.rig.camera.centre_px.y(), 4.0);
}

TEST(AccuracyRows, ObjectsAreWhereTheRowSays) {
  for (const Row& row : accuracy_rows())
    for (std::uint64_t i = 0; i < 20 && !needs_photographs(row); ++i) {
      const Trial trial = draw_trial(row, i);
      const sim::TrueRobot robot = sim::true_robot(trial.scene, *geometry::robot_profile("nao-v6"));
      const geometry::Pose cam1 = geometry::cam_from_torso(robot.head, geometry::HeadAngles{});
      const Eigen::Vector3d in_cam = cam1 * object_of(trial).centre_m;
      EXPECT_NEAR(in_cam.norm(), trial.range_m, 1e-9);
      EXPECT_GE(trial.range_m, row.range_min_m * (1.0 - 1e-12));
      EXPECT_LE(trial.range_m, row.range_max_m * (1.0 + 1e-12));
      EXPECT_TRUE(robot.camera.contains(*geometry::project(robot.camera, in_cam), 16.0));
      if (row.region == Region::level_or_below) {
        EXPECT_LE(trial.elevation_rad, 0.0);
      }
      if (row.region == Region::above_level) {
        EXPECT_GT(trial.elevation_rad, 0.0);
        EXPECT_LE(trial.elevation_rad, 0.3);
      }
    }
}

TEST(ClosedLoop, JudgesByTheScenePointUnderPixelOne) {
  const Trial trial = draw_trial(row_named("blank_03"), 1);
  cycle::CycleSettings settings = trial.settings.cycle;
  settings.locate.looks = 3;
  ClosedLoop loop(trial.scene, *geometry::robot_profile("nao-v6"), trial.settings.rig, settings,
                  trial.seed);
  const JudgedFixation judged = loop.next();
  ASSERT_EQ(judged.fixation.status, cycle::Status::located) << judged.fixation.reason;
  ASSERT_TRUE(judged.truth);
  // Any place on the object is within its size of its centre.
  EXPECT_NEAR(judged.truth->range_m, trial.range_m, 0.06);
  EXPECT_NEAR(judged.fixation.estimate.range_m, judged.truth->range_m, 0.1);
  // Zeros and mount 3 mrad, arm 1 mm at 0.3 m: 0.1 rad would be another point.
  EXPECT_LT(judged.bearing_error_rad, 0.05);
  EXPECT_GT(judged.cycle_ms, judged.locate_ms);
}

TEST(ClosedLoop, WhatSeesNothingHasNoTruth) {
  Trial trial = draw_trial(row_named("blank_03"), 1);
  trial.scene.planes.clear();
  ClosedLoop loop(trial.scene, *geometry::robot_profile("nao-v6"), trial.settings.rig,
                  trial.settings.cycle, 1);
  const JudgedFixation judged = loop.next();
  EXPECT_EQ(judged.fixation.status, cycle::Status::no_salient_object);
  EXPECT_FALSE(judged.truth);
  EXPECT_TRUE(std::isnan(judged.bearing_error_rad));
}

}  // namespace
}  // namespace gazed::benchmarks::accuracy_test
