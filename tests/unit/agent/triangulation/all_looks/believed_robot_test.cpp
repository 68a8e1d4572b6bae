// What the looks teach about the robot itself, and that the answer's parts agree with it.
#include "agent/triangulation/all_looks/believed_robot.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

#include "tests/unit/agent/triangulation/rooms.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::triangulation::all_looks::believed_robot_test {
namespace {

const int rooms = test::trials(200, 40);

TEST(BelievedRobot, ItsChainAtTheFirstReadingTakesThePointToTheTorso) {
  Random random(71);
  int located = 0;
  for (int i = 0; i < rooms; ++i) {
    const Room room =
        random_room({.features = i % 2 == 0 ? 100U : 0U, .encoder_sigma_rad = 20e-3}, random);
    const Estimate estimate = room.locate();
    if (!estimate.point.torso_point_m.allFinite()) continue;
    ++located;
    const Eigen::Vector3d torso_point_m =
        geometry::cam_from_torso(estimate.robot.head, estimate.reading[0]).inverse() *
        estimate.point.point_m;
    ASSERT_LT((torso_point_m - estimate.point.torso_point_m).norm(), 1e-9);
  }
  EXPECT_GT(located, rooms / 2);
}

TEST(BelievedRobot, BeforeAnyLookIsTheRig) {
  Random random(72);
  const Room room = random_room({}, random);
  const BelievedRobot robot = believed_before(room.rig);
  EXPECT_EQ(robot.head.mount_offset_m, room.rig.head.mount_offset_m);
  EXPECT_EQ(robot.mount_offset_sigma_m.y(), room.rig.uncertainty.mount_offset_sigma_m);
  EXPECT_EQ(robot.zero_sigma_rad.x(), room.rig.uncertainty.zero_sigma_rad);
}

/// Mean square of what is off, in its own sigmas; and how much of the sigma before is left.
struct Spread {
  double squares = 0.0, sigmas = 0.0;
  int count = 0;

  void add(double error, double sigma, double sigma_before) {
    squares += error * error / (sigma * sigma);
    sigmas += sigma / sigma_before;
    ++count;
  }
  [[nodiscard]] double mean_square() const { return squares / count; }
  [[nodiscard]] double share_left() const { return sigmas / count; }
};

// Each error is drawn from the sigma that it is believed with: what is left of it must be as large
// as the sigma that is left.
TEST(BelievedRobot, ItsSigmasAreTrue) {
  Random random(73);
  Spread focal, centre, lens, rotation, offset, zero;
  for (int i = 0; i < rooms; ++i) {
    const Room room = random_room({.distortion_sigma = {0.03, 0.05}}, random);
    const Estimate estimate = room.locate();
    if (estimate.refinement != Refinement::used) continue;
    const BelievedRobot& robot = estimate.robot;
    const geometry::Uncertainty& before = room.rig.uncertainty;
    focal.add(robot.camera.focal_px.x() - room.true_camera.focal_px.x(), robot.focal_sigma_px,
              before.focal_sigma_px);
    for (std::size_t k = 0; k < 2; ++k) {
      lens.add(robot.camera.distortion[k] - room.true_camera.distortion[k],
               robot.distortion_sigma(static_cast<int>(k)), before.distortion_sigma[k]);
    }
    for (int axis = 0; axis < 2; ++axis)
      centre.add(robot.camera.centre_px(axis) - room.true_camera.centre_px(axis),
                 robot.centre_sigma_px(axis), before.centre_sigma_px);
    for (int axis = 0; axis < 3; ++axis) {
      rotation.add(robot.head.mount_rotation_rad(axis) - room.true_head.mount_rotation_rad(axis),
                   robot.mount_rotation_sigma_rad(axis), before.mount_rotation_sigma_rad);
      offset.add(robot.head.mount_offset_m(axis) - room.true_head.mount_offset_m(axis),
                 robot.mount_offset_sigma_m(axis), before.mount_offset_sigma_m);
    }
    const geometry::HeadAngles wrong = robot.head.zero - room.true_head.zero;
    zero.add(wrong.yaw_rad, robot.zero_sigma_rad.x(), before.zero_sigma_rad);
    zero.add(wrong.pitch_rad, robot.zero_sigma_rad.y(), before.zero_sigma_rad);
  }
  ASSERT_GT(focal.count, rooms / 2);
  // A mean of that many squares of standard normal numbers is within this of 1 in all but one case
  // of a thousand, if they were independent.
  const double tolerance = 3.3 * std::sqrt(2.0 / focal.count);
  for (const Spread& spread : {focal, centre, lens, rotation, offset, zero}) {
    EXPECT_NEAR(spread.mean_square(), 1.0, tolerance);
    EXPECT_LE(spread.share_left(), 1.0);
  }
  EXPECT_LT(rotation.share_left(), 0.9) << "the looks teach nothing of the mount";
}

TEST(BelievedRobot, LooksThatTellNothingLeaveTheRigAsItWas) {
  Random random(74);
  Room room = random_room({.features = 0}, random);
  for (std::size_t k = 1; k < room.looks.size(); ++k) room.looks[k].pixel.setConstant(not_a_number);
  const Estimate estimate = room.locate();
  EXPECT_EQ(estimate.robot.head.mount_rotation_rad, room.rig.head.mount_rotation_rad);
  EXPECT_EQ(estimate.robot.focal_sigma_px, room.rig.uncertainty.focal_sigma_px);
  EXPECT_EQ(estimate.reading[0], room.looks[0].head);
}

TEST(LookVerdicts, EveryLaterLookThatIsUsedHasItsChiSquare) {
  Random random(75);
  Spread look;
  for (int i = 0; i < rooms; ++i) {
    const Room room = random_room({}, random);
    const Estimate estimate = room.locate();
    EXPECT_TRUE(std::isnan(estimate.looks[0].chi2));
    for (std::size_t k = 1; k < room.looks.size(); ++k) {
      if (!estimate.looks[k].used) continue;
      ASSERT_TRUE(std::isfinite(estimate.looks[k].chi2));
      look.add(std::sqrt(0.5 * estimate.looks[k].chi2), 1.0, 1.0);  // two degrees of freedom
    }
  }
  EXPECT_NEAR(look.mean_square(), 1.0, 0.15);
}

TEST(FeatureVerdicts, TellInWhichLooksAFeatureWasBelieved) {
  Random random(76);
  const Room room = random_room({.wrong_share = 0.2}, random);
  const Estimate estimate = room.locate();
  ASSERT_EQ(estimate.refinement, Refinement::used);
  std::size_t used = 0;
  for (std::size_t i = 0; i < room.features.size(); ++i) {
    if (estimate.feature_used_in[i] != 0) ++used;
    for (std::size_t k = 0; k < room.looks.size(); ++k) {
      if ((estimate.feature_used_in[i] >> k & 1U) == 0) continue;
      EXPECT_TRUE(room.features[i].pixel[k].allFinite());
    }
  }
  EXPECT_EQ(used, estimate.features_used);
  EXPECT_LT(used, room.features.size());
}

}  // namespace
}  // namespace gazed::triangulation::all_looks::believed_robot_test
