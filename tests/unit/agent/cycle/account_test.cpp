// How a fixation's answer came about, as it is told: every look, the robot as believed after them,
// and what the report's own six steps say.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <span>
#include <string_view>
#include <vector>

#include "agent/triangulation/report_answer.hpp"

#include "tests/unit/agent/cycle/simulated_head.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::cycle::account_test {
namespace {

using ::testing::IsEmpty;

/// A papered wall, so that there is a background to follow, and a robot that is not quite what it
/// is believed to be and measures badly.
constexpr std::string_view papered_wall = R"toml(repeat = true
[robot]
mount_offset_m = [0.0595, -0.0008, 0.0643]
mount_rotation_rad = [0.002, 0.0182, -0.003]
zero_rad = [-0.003, 0.004]
[joints]
encoder_sigma_rad = 0.02
[camera]
pixel_noise = 2.0
[wall]
size_m = [8.0, 6.0]
texture = { pattern = "leaves", colour = [186, 184, 179], contrast = 12, tile_m = 0.9, seed = 7 }
[object]
shape = "disc"
size_m = [0.16, 0.16]
texture = { pattern = "natural", colour = [196, 26, 30], contrast = 2.0, tile_m = 0.1, seed = 2 }
[[report_test]]
number = 1
range_m = 1.0
[[report_test]]
number = 2
range_m = 1.0
)toml";

HeadSetup badly_measuring(int looks) {
  HeadSetup setup = calibrated_nao_v6();
  setup.rig.uncertainty.encoder_sigma_rad = 0.02;
  setup.cycle.locate.looks = setup.cycle.locate.looks_min = looks;
  setup.cycle.locate.plan = gaze::Plan::parallax;
  return setup;
}

std::span<const FixationLook> looks_of(const Fixation& fixation) {
  return std::span(fixation.looks).first(fixation.look_count);
}

/// camera_position_m through the chain.
Eigen::Vector3d through_chain(const geometry::HeadGeometry& head, geometry::HeadAngles angles,
                              const Fixation& fixation) {
  return geometry::cam_from_torso(head, angles).inverse() * fixation.estimate.point_m;
}

TEST(Account, PositionCameraPositionAndRefinedAnglesAgree) {
  const HeadSetup setup = badly_measuring(6);
  SimulatedHead dut(papered_wall, setup);
  int located = 0;
  double by_measured_m = 0.0;
  for (int i = 0; i < test::trials(10, 2); ++i) {
    const auto fixation = dut.run(60.0);
    ASSERT_TRUE(fixation);
    dut.robot->next_test();
    const Eigen::Vector3d& position_m = fixation->estimate.torso_point_m;
    if (!position_m.allFinite()) continue;
    ++located;
    const FixationLook& first = fixation->looks.front();
    EXPECT_LT((through_chain(fixation->robot.head, first.refined, *fixation) - position_m).norm(),
              1e-9);
    EXPECT_EQ(first.measured, fixation->head_1);
    by_measured_m =
        std::max(by_measured_m,
                 (through_chain(setup.rig.head, fixation->head_1, *fixation) - position_m).norm());
  }
  EXPECT_GT(located, 0);
  EXPECT_GT(by_measured_m, 5e-3) << "the measured angles would have done";
}

TEST(Account, EveryLookIsTold) {
  SimulatedHead dut(papered_wall, badly_measuring(5));
  std::vector<std::int64_t> used_us;
  dut.looked = [&](const UsedSaliency& used) { used_us.push_back(used.utime_us); };
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  ASSERT_EQ(fixation->status, Status::located) << fixation->reason;
  ASSERT_EQ(fixation->look_count, 5U);
  EXPECT_GT(fixation->patch_half_size_px, 0.0);
  EXPECT_GT(fixation->budget.of(triangulation::all_looks::Cause::encoders), 0.0);
  std::size_t corners = 0, used_corners = 0;
  for (std::size_t k = 0; k < fixation->look_count; ++k) {
    const FixationLook& look = fixation->looks[k];
    EXPECT_EQ(look.utime_us, used_us[k]);
    EXPECT_TRUE(look.used) << look.reason;
    EXPECT_THAT(look.reason, IsEmpty());
    EXPECT_TRUE(look.pixel.allFinite() && look.covariance_px2.allFinite());
    EXPECT_EQ(look.covariance_px2.isZero(), k == 0);
    EXPECT_LT(geometry::greatest_difference(look.refined, look.measured), 0.08);
    EXPECT_EQ(std::isfinite(look.chi2), k > 0);
    EXPECT_EQ(look.epipole.allFinite(), k > 0);
    EXPECT_EQ(std::isfinite(look.pair_inverse_range_per_m), k > 0);
    EXPECT_EQ(std::isfinite(look.pair_inverse_range_sigma_per_m), k > 0);
    for (const LookCorner& corner : std::span(look.corners).first(look.corner_count)) {
      EXPECT_TRUE(dut.robot->truth().camera.contains(corner.pixel.cast<double>(), -0.5));
      ++corners;
      if (corner.used) ++used_corners;
    }
  }
  EXPECT_EQ(fixation->looks.front().pixel, fixation->pixel_1);
  EXPECT_EQ(fixation->looks[4].pixel, fixation->pixel_2);
  EXPECT_GT(fixation->features_used, 20U);
  EXPECT_GT(used_corners, 2 * fixation->features_used);
  EXPECT_GE(corners, used_corners);
}

// Every point of look 1's ray is seen on a line through the epipole.
TEST(Account, TheEpipoleIsWhereCamera1Is) {
  SimulatedHead dut(papered_wall, badly_measuring(4));
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  const geometry::CameraModel& camera = fixation->robot.camera;
  const Eigen::Vector3d ray =
      geometry::normalise(camera, fixation->pixel_1)->homogeneous().normalized();
  int judged = 0;
  for (std::size_t k = 1; k < fixation->look_count; ++k) {
    const FixationLook& look = fixation->looks[k];
    const geometry::HeadGeometry& head = fixation->robot.head;
    const geometry::Pose pose =
        geometry::cam_from_torso(head, look.refined) * look.torso_1_from_torso.inverse() *
        geometry::cam_from_torso(head, fixation->looks[0].refined).inverse();
    // Undistorted, where lines are straight.
    const Eigen::Vector2d near = (pose * Eigen::Vector3d(0.3 * ray)).hnormalized(),
                          far = (pose * Eigen::Vector3d(30.0 * ray)).hnormalized();
    if (look.epipole.hasNaN()) continue;  // so far outside that the lens has no pixel for it
    const auto epipole = geometry::normalise(camera, look.epipole);
    ASSERT_TRUE(epipole);
    ++judged;
    const Eigen::Vector2d along = (near - far).normalized(), to = *epipole - far;
    EXPECT_LT(std::abs(along.x() * to.y() - along.y() * to.x()), 1e-6 * to.norm());
  }
  EXPECT_GE(judged, 2);
}

TEST(Account, TheOutlineIsTheObjects) {
  SimulatedHead dut(papered_wall, badly_measuring(2));
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  ASSERT_GE(fixation->outline.count, 48U);
  const double radius_px = 0.08 / 1.0 * 608.0;  // of the disc, 1 m away
  // The outline is known to a cell of 4 px, and so is the disc's centre, for which pixel_1 stands.
  constexpr double tolerance_px = 8.0;
  double mean_px = 0.0;
  for (const Eigen::Vector2f& point :
       std::span(fixation->outline.points_px).first(fixation->outline.count)) {
    const double away_px = (point.cast<double>() - fixation->pixel_1).norm();
    EXPECT_NEAR(away_px, radius_px, tolerance_px);
    mean_px += away_px / static_cast<double>(fixation->outline.count);
  }
  EXPECT_NEAR(mean_px, radius_px, 0.5 * tolerance_px);
}

TEST(Account, AMissedLookSaysWhy) {
  SimulatedHead dut(papered_wall, badly_measuring(5));
  base::Image blank(640, 480, base::PixelFormat::rgb24);
  dut.seen = [&](const geometry::Frame& frame) {
    return dut.commands == 1 ? geometry::Frame{blank.view(), frame.utime_us} : frame;
  };
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  ASSERT_EQ(fixation->status, Status::located) << fixation->reason;
  ASSERT_EQ(fixation->look_count, 5U);
  EXPECT_EQ(fixation->views, 4);
  const FixationLook& missed = fixation->looks[1];
  EXPECT_FALSE(missed.used);
  EXPECT_FALSE(missed.reason.empty());
  EXPECT_TRUE(geometry::finite(missed.measured));
  EXPECT_FALSE(geometry::finite(missed.refined));
  EXPECT_TRUE(std::isnan(missed.pixel.x()));
  EXPECT_EQ(missed.corner_count, 0U);
  EXPECT_TRUE(fixation->looks[2].used);
  EXPECT_EQ(fixation->looks[4].pixel, fixation->pixel_2);
}

TEST(Account, NothingSalientHasNoLooksAndTheRobotAsConfigured) {
  const HeadSetup setup = calibrated_nao_v6();
  SimulatedHead dut(bare_wall, setup);
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  ASSERT_EQ(fixation->status, Status::no_salient_object);
  EXPECT_THAT(looks_of(*fixation), IsEmpty());
  EXPECT_EQ(fixation->outline.count, 0U);
  EXPECT_TRUE(std::isnan(fixation->report_position_m.x()));
  EXPECT_EQ(fixation->robot.head.mount_offset_m, setup.rig.head.mount_offset_m);
  EXPECT_EQ(fixation->robot.camera.focal_px, setup.rig.camera.focal_px);
  EXPECT_EQ(fixation->robot.focal_sigma_px, setup.rig.uncertainty.focal_sigma_px);
}

TEST(Account, AHeadThatDoesNotTurnHasOneLook) {
  SimulatedHead dut(report_test_1, calibrated_nao_v6());
  dut.obeys = false;
  const auto fixation = dut.run();
  ASSERT_TRUE(fixation);
  ASSERT_EQ(fixation->status, Status::head_fault);
  ASSERT_EQ(fixation->look_count, 1U);
  const FixationLook& look = fixation->looks.front();
  EXPECT_EQ(look.measured, fixation->head_1);
  EXPECT_EQ(look.pixel, fixation->pixel_1);
  EXPECT_FALSE(look.used);
  EXPECT_FALSE(geometry::finite(look.refined));
  EXPECT_TRUE(std::isnan(fixation->report_position_m.x()));
}

TEST(Account, TheReportsSixStepsAreItsWinnersAtTheMeasuredAngles) {
  const HeadSetup setup = badly_measuring(4);
  SimulatedHead dut(papered_wall, setup);
  std::vector<geometry::Pixel> winners;
  dut.looked = [&](const UsedSaliency& used) { winners.push_back(used.result.peak_px); };
  const auto fixation = dut.run(60.0);
  ASSERT_TRUE(fixation);
  ASSERT_GE(winners.size(), 2U);
  const Eigen::Vector3d expected_m = triangulation::report_answer_m(
      setup.rig,
      {fixation->looks[0].measured, fixation->looks[1].measured, winners[0], winners[1]});
  ASSERT_TRUE(expected_m.allFinite());
  EXPECT_EQ(fixation->report_position_m, expected_m);
}

}  // namespace
}  // namespace gazed::cycle::account_test
