#include "agent/tracking/warp.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gmock/gmock.h>

#include "agent/geometry/chain.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::tracking::warp_test {
namespace {

constexpr double exact = 1e-9;  // px; the two ways differ by rounding only

struct Looks {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  PatchMotion motion{geometry::cam2_from_cam1(rig.head, {0.1, -0.05}, {-0.25, 0.1}), {0.08, -0.12}};
};

TEST(PatchWarp, IsExactForPlanes) {
  const Looks looks;
  // Points of a plane: n . x = 1, so that the inverse depth is n . (n1, 1).
  const Eigen::Vector3d plane(1.1, -0.7, 2.8);
  PatchWarp warp;
  warp.inverse_depth_per_m = plane.dot(looks.motion.reference.homogeneous());
  warp.slope_per_m = plane.head<2>();
  const Eigen::Matrix3d homography = looks.motion.homography(warp);
  for (const Eigen::Vector2d& n1 :
       {Eigen::Vector2d(0.08, -0.12), Eigen::Vector2d(0.2, 0.1), Eigen::Vector2d(-0.1, -0.2)}) {
    const Eigen::Vector3d point = n1.homogeneous() / plane.dot(n1.homogeneous());
    const auto seen = geometry::project(looks.rig.camera, looks.motion.cam2_from_cam1 * point);
    const auto warped = geometry::project(looks.rig.camera, homography * n1.homogeneous());
    ASSERT_TRUE(seen && warped);
    EXPECT_LT((*seen - *warped).norm(), exact);
  }
}

TEST(PatchWarp, ScaleIsTheRatioOfDistancesForAFacingPatch) {
  // A camera that goes straight ahead by a tenth of the distance.
  const PatchMotion motion{{Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.05}}, {0.0, 0.0}};
  PatchWarp warp;
  warp.inverse_depth_per_m = 2.0;
  EXPECT_NEAR(motion.scale(warp), 0.5 / 0.45, exact);
  warp.log_scale = 0.1;
  EXPECT_NEAR(motion.scale(warp), 0.5 / 0.45 * std::exp(0.1), exact);
}

TEST(PatchWarp, PureRotationHasScaleOne) {
  const PatchMotion motion{
      {geometry::about_y(0.4) * geometry::about_x(0.2), Eigen::Vector3d::Zero()}, {0.2, 0.1}};
  PatchWarp warp;
  warp.inverse_depth_per_m = 3.0;
  EXPECT_NEAR(motion.scale(warp), 1.0, exact);
}

TEST(PatchWarp, WarpToPutsTheReferenceOnThePixel) {
  const Looks looks;
  const EpipolarSegment segment(looks.motion, looks.rig.camera, 0.1, 10.0);
  ASSERT_TRUE(segment.valid());
  const geometry::Pixel off_the_line = segment.knot(4) + geometry::Pixel(-7.0, 9.0);
  const auto warp = warp_to(looks.motion, looks.rig.camera, segment, off_the_line);
  ASSERT_TRUE(warp);
  const auto pixel = looks.motion.reference_in_view_2(looks.rig.camera, *warp);
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - off_the_line).norm(), exact);
}

TEST(EpipolarSegment, NearestIsAtTheInverseDepthThatProjectsThere) {
  const Looks looks;
  const EpipolarSegment segment(looks.motion, looks.rig.camera, 0.1, 10.0);
  for (const double inverse_depth : {0.1, 0.7, 3.3, 8.0, 10.0}) {
    PatchWarp warp;
    warp.inverse_depth_per_m = inverse_depth;
    const auto pixel = looks.motion.reference_in_view_2(looks.rig.camera, warp);
    ASSERT_TRUE(pixel);
    const auto nearest = segment.nearest(*pixel);
    EXPECT_LT(nearest.distance_px, exact);  // no distortion: a straight line
    // Knots are joined linearly; perspective bends the spacing between them by this much.
    EXPECT_NEAR(nearest.inverse_depth_per_m, inverse_depth, 0.02);
  }
}

TEST(EpipolarSegment, WithoutABaselineIsOnePoint) {
  const Looks looks;
  const PatchMotion still{geometry::cam2_from_cam1(looks.rig.head, {0.1, 0.1}, {0.1, 0.1}),
                          {0.0, 0.1}};
  const EpipolarSegment segment(still, looks.rig.camera, 0.1, 10.0);
  ASSERT_TRUE(segment.valid());
  EXPECT_LT((segment.knot(0) - segment.knot(EpipolarSegment::knots - 1)).norm(), exact);
  EXPECT_NEAR(segment.nearest(segment.knot(0) + geometry::Pixel(3.0, 4.0)).distance_px, 5.0, exact);
}

TEST(EpipolarSegment, BehindTheCameraIsNotValid) {
  const Looks looks;
  const PatchMotion backwards{geometry::cam2_from_cam1(looks.rig.head, {0.0, 0.0}, {3.0, 0.0}),
                              {0.0, 0.0}};
  EXPECT_FALSE(EpipolarSegment(backwards, looks.rig.camera, 0.1, 10.0).valid());
}

}  // namespace
}  // namespace gazed::tracking::warp_test
