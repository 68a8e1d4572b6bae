#include "agent/cycle/earlier_fixation.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/geometry/robot.hpp"
#include "agent/triangulation/all_looks/believed_robot.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"

namespace gazed::cycle::earlier_fixation_test {
namespace {

using ::testing::HasSubstr;

constexpr double second_us = 1e6;

/// Of an object of 60 mm, straight ahead of camera 1.
Fixation located(double range_m, double relative_sigma, std::int64_t utime_us) {
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  const geometry::Pose torso_from_cam1 =
      geometry::cam_from_torso(rig.head, geometry::HeadAngles{}).inverse();
  Fixation out;
  out.number = 1;
  out.utime_us = utime_us + 500'000;
  out.status = Status::located;
  out.reason = "as it was";
  out.pixel_1 = rig.camera.centre_px;
  out.robot = triangulation::all_looks::believed_before(rig);
  out.looks[0].utime_us = utime_us;
  out.looks[0].measured = out.looks[0].refined = {};
  out.look_count = 1;
  out.outline.count = 4;
  const auto radius_px = static_cast<float>(0.03 / range_m * rig.camera.focal_px.x());
  const Eigen::Vector2f centre_px = out.pixel_1.cast<float>();
  for (int i = 0; i < 4; ++i) {
    out.outline.points_px[static_cast<std::size_t>(i)] =
        centre_px + radius_px * Eigen::Vector2f(i % 2 == 0 ? 1.0F : -1.0F, 0.0F);
  }
  const Eigen::Vector3d sigma_m(0.002, 0.002, relative_sigma * range_m);
  const Eigen::Matrix3d& axes = torso_from_cam1.rotation;
  out.estimate.torso_point_m = torso_from_cam1 * Eigen::Vector3d(0.0, 0.0, range_m);
  out.estimate.torso_covariance_m2 =
      axes * sigma_m.cwiseAbs2().asDiagonal().toDenseMatrix() * axes.transpose();
  return out;
}

/// What becomes of the second of two.
Fixation second_of(Fixation first, Fixation second) {
  geometry::Uncertainty still = geometry::robot_profile("nao-v6")->rig.uncertainty;
  still.torso_rotation_sigma_rad = still.torso_translation_sigma_m = 0.0;
  EarlierFixation earlier(still);
  earlier.hold_against(first);
  earlier.hold_against(second);
  return second;
}

constexpr std::int64_t then_us = 1'700'000'000'000'000;
constexpr std::int64_t soon_us = then_us + static_cast<std::int64_t>(0.6 * second_us);

TEST(EarlierFixation, AContradictingOneIsNotBelieved) {
  const Fixation second = second_of(located(0.447, 0.04, then_us), located(0.300, 0.04, soon_us));
  EXPECT_EQ(second.status, Status::uncertain);
  EXPECT_THAT(second.reason, HasSubstr("as it was; fixation 1, 0.1 s before, contradicts it"));
  // 1 / 0.300 and 1 / 0.447, sigmas 0.04 of each.
  EXPECT_THAT(second.reason, HasSubstr("inverse range 2.237 1/m, not 3.333, 6.8 sigmas apart"));
}

TEST(EarlierFixation, AnAgreeingOneIs) {
  const Fixation second = second_of(located(0.310, 0.04, then_us), located(0.300, 0.04, soon_us));
  EXPECT_EQ(second.status, Status::located);
  EXPECT_EQ(second.reason, "as it was");
}

TEST(EarlierFixation, AnotherObjectContradictsNothing) {
  Fixation beside = located(0.447, 0.04, then_us);
  beside.estimate.torso_point_m.y() += 0.1;
  EXPECT_EQ(second_of(beside, located(0.300, 0.04, soon_us)).status, Status::located);
}

TEST(EarlierFixation, AStepAsideWithinTheObjectIsAContradictionToo) {
  Fixation aside = located(0.300, 0.04, then_us);
  aside.estimate.torso_point_m.y() += 0.015;
  const Fixation second = second_of(aside, located(0.300, 0.04, soon_us));
  EXPECT_EQ(second.status, Status::uncertain);
  EXPECT_THAT(second.reason, HasSubstr("49.9 mrad in direction"));
}

TEST(EarlierFixation, ALongTimeAgoIsForgotten) {
  const auto later_us = then_us + static_cast<std::int64_t>(3.0 * second_us);
  EXPECT_EQ(second_of(located(0.447, 0.04, then_us), located(0.300, 0.04, later_us)).status,
            Status::located);
}

TEST(EarlierFixation, OneOfAClockThatWasSetBackSinceSaysNothing) {
  constexpr std::int64_t hour_us = 3'600'000'000;
  EXPECT_EQ(
      second_of(located(0.447, 0.04, then_us + hour_us), located(0.300, 0.04, soon_us)).reason,
      "as it was");
}

TEST(EarlierFixation, OneWithoutAPointIsNone) {
  Fixation lost;
  lost.utime_us = then_us;
  EXPECT_EQ(second_of(lost, located(0.300, 0.04, soon_us)).status, Status::located);
}

TEST(EarlierFixation, ATorsoThatMaySwayMayExplainIt) {
  geometry::Uncertainty swaying = geometry::robot_profile("nao-v6")->rig.uncertainty;
  swaying.torso_translation_sigma_m = 0.05;
  EarlierFixation earlier(swaying);
  Fixation first = located(0.447, 0.04, then_us), second = located(0.300, 0.04, soon_us);
  earlier.hold_against(first);
  earlier.hold_against(second);
  EXPECT_EQ(second.status, Status::located);
}

// An object that is moved from one fixation to the next, along the line of sight.
TEST(EarlierFixation, OfAWholeCycleIsHeldAgainstTheNext) {
  HeadSetup setup = calibrated_nao_v6();
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = 4;
  SimulatedHead dut(
      "[camera]\npixel_noise = 2.0\n[[report_test]]\nnumber = 1\nrange_m = 0.3\n"
      "[[report_test]]\nnumber = 1\nrange_m = 0.45\n",
      setup);
  const auto first = dut.run();
  ASSERT_TRUE(first);
  ASSERT_EQ(first->status, Status::located) << first->reason;
  dut.robot->next_test();
  const auto second = dut.run();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->status, Status::uncertain);
  EXPECT_THAT(second->reason, HasSubstr("contradicts it"));
  EXPECT_NEAR(second->estimate.range_m, 0.45, 0.05);
}

}  // namespace
}  // namespace gazed::cycle::earlier_fixation_test
