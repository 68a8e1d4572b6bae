#include "agent/lab/explain/look_pair.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "agent/geometry/robot.hpp"
#include "agent/triangulation/all_looks/believed_robot.hpp"

namespace gazed::lab::explain::look_pair_test {
namespace {

const Eigen::Vector3d point_m(0.8, 0.05, 0.2);  // torso frame
constexpr geometry::HeadAngles angles_1{0.0, 0.0}, angles_2{-0.3, 0.15};
// A line of 64 pieces is this far from the curve that a lens makes of it, px.
constexpr double of_pieces_px = 0.01;

geometry::Pixel seen(const geometry::Rig& rig, geometry::HeadAngles head) {
  return geometry::project(rig.camera, geometry::cam_from_torso(rig.head, head) * point_m).value();
}

geometry::Rig rig_with_a_lens() {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  rig.camera.distortion = {-0.02, 0.01, 0.0, 0.0, 0.0};
  return rig;
}

cycle::Fixation two_looks(const geometry::Rig& rig) {
  cycle::Fixation fixation;
  fixation.robot = triangulation::all_looks::believed_before(rig);
  fixation.look_count = 2;
  fixation.looks[0].measured = fixation.looks[0].refined = angles_1;
  fixation.looks[1].measured = fixation.looks[1].refined = angles_2;
  fixation.looks[0].pixel = fixation.pixel_1 = seen(rig, angles_1);
  fixation.looks[1].pixel = seen(rig, angles_2);
  return fixation;
}

/// From a pixel to a line of pieces.
double distance_px(const PixelLine& line, const geometry::Pixel& pixel) {
  double least_px = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d way = line[i] - line[i - 1];
    const double share = std::clamp(way.dot(pixel - line[i - 1]) / way.squaredNorm(), 0.0, 1.0);
    least_px = std::min(least_px, (line[i - 1] + share * way - pixel).norm());
  }
  return least_px;
}

TEST(LookPair, EachLineGoesThroughTheOthersPixel) {
  const cycle::Fixation fixation = two_looks(rig_with_a_lens());
  const auto pair = pair_of(fixation, 1);
  ASSERT_TRUE(pair);
  EXPECT_LT(distance_px(pair->line_in_later(fixation.looks[0].pixel, 0.1), fixation.looks[1].pixel),
            of_pieces_px);
  EXPECT_LT(distance_px(pair->line_in_first(fixation.looks[1].pixel, 0.1), fixation.looks[0].pixel),
            of_pieces_px);
}

TEST(LookPair, TheEpipoleIsWhereTheOtherCameraIs) {
  const geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  const auto pair = pair_of(two_looks(rig), 1);
  ASSERT_TRUE(pair);
  const Eigen::Vector3d centre_1_m = geometry::origin(geometry::cam_from_torso(rig.head, angles_1));
  const Eigen::Vector3d in_cam2_m = geometry::cam_from_torso(rig.head, angles_2) * centre_1_m;
  const Eigen::Vector2d expected = geometry::pixel_of(rig.camera, in_cam2_m.hnormalized());
  constexpr double rounding_px = 1e-6;
  EXPECT_LT((pair->epipole_in_later() - expected).norm(), rounding_px);
  EXPECT_NEAR(pair->baseline_m(), in_cam2_m.norm(), 1e-12);
}

TEST(LookPair, AnglesToTheBaselineAreThoseOfTheRays) {
  const cycle::Fixation fixation = two_looks(geometry::robot_profile("nao-v6")->rig);
  const auto pair = pair_of(fixation, 1);
  const geometry::Pixel epipole = pair->epipole_in_first();
  constexpr double rounding_rad = 1e-6;
  EXPECT_NEAR(pair->angle_to_baseline_rad(epipole), 0.0, rounding_rad);
  EXPECT_GT(pair->angle_to_baseline_rad(fixation.pixel_1), 0.5);
}

TEST(LookPair, ALookThatMissedIsDrawnByItsMeasuredAngles) {
  cycle::Fixation fixation = two_looks(geometry::robot_profile("nao-v6")->rig);
  fixation.looks[1].refined = cycle::no_angles;
  EXPECT_TRUE(pair_of(fixation, 1));
  fixation.looks[1].measured = cycle::no_angles;
  EXPECT_FALSE(pair_of(fixation, 1));
}

TEST(LookPair, Look1HasNoneAndNeitherHasOneThatWasNotTaken) {
  const cycle::Fixation fixation = two_looks(geometry::robot_profile("nao-v6")->rig);
  EXPECT_FALSE(pair_of(fixation, 0));
  EXPECT_FALSE(pair_of(fixation, 2));
}

TEST(LookPair, FromOnePlaceThereIsNoEpipole) {
  cycle::Fixation fixation = two_looks(geometry::robot_profile("nao-v6")->rig);
  fixation.robot.head.mount_offset_m.setZero();
  fixation.looks[1].refined = fixation.looks[1].measured = angles_1;
  const auto pair = pair_of(fixation, 1);
  EXPECT_FALSE(pair->epipole_in_later().allFinite());
  EXPECT_TRUE(std::isnan(epipole_distance_px(*pair)));
}

}  // namespace
}  // namespace gazed::lab::explain::look_pair_test
