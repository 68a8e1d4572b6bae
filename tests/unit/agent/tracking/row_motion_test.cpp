#include "agent/tracking/row_motion.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/robot.hpp"

namespace gazed::tracking::row_motion_test {
namespace {

// Second order in a sweep of 2 mrad, normalised coordinates.
constexpr double tolerance = 1e-6;

TEST(RowMotion, IsUndoneForAFarPoint) {
  geometry::Rig rig = geometry::robot_profile("nao-v6")->rig;
  rig.head.zero = {0.1, -0.05};
  const base::Image image(rig.camera.width_px, rig.camera.height_px, base::PixelFormat::rgb24);
  const geometry::View view{.image = image.view(),
                            .head = {0.6, 0.2},
                            .utime_us = 0,
                            .sweep = {2e-3, -1.5e-3},
                            .sweep_sigma_rad = 5e-4};
  const RowMotion dut(rig.head, view);
  for (const double row_px : {0.0, 100.0, 239.5, 479.0}) {
    const Eigen::Vector3d far_m = 1e6 * Eigen::Vector3d(0.8, 0.5, -0.1);
    const auto direction = [&](geometry::HeadAngles angles) {
      return Eigen::Vector2d((geometry::cam_from_torso(rig.head, angles) * far_m).hnormalized());
    };
    const Eigen::Vector2d seen = direction(view.head_at_row(row_px));
    EXPECT_LT((dut.undone(seen, row_px) - direction(view.head)).norm(), tolerance) << row_px;
  }
  EXPECT_EQ(dut.sigma(239.5), 0.0);
  EXPECT_DOUBLE_EQ(dut.sigma(0.0), 2.5e-4);
  EXPECT_DOUBLE_EQ(dut.sigma(479.0), 2.5e-4);
}

}  // namespace
}  // namespace gazed::tracking::row_motion_test
