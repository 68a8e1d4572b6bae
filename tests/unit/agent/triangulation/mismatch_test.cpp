// Image points that show different scene points: what one method calls lost, no other may locate.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "agent/geometry/chain.hpp"
#include "agent/triangulation/estimate.hpp"

#include "estimates.hpp"
#include "golden.hpp"
#include "method_name.hpp"
#include "problems.hpp"
#include "scenes.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::triangulation::mismatch_test {
namespace {

using Eigen::Vector3d;

constexpr double sigma_px = 0.3;

class Mismatches : public testing::TestWithParam<methods::Method> {
 protected:
  static TwoViews views_of(const geometry::Pose& cam2_from_cam1, const geometry::Pixel& pixel_1,
                           const geometry::Pixel& pixel_2) {
    const geometry::CameraModel camera = report_scene().camera;
    const Eigen::Matrix2d noise_px2 = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
    return {cam2_from_cam1,
            image_point(camera, pixel_1, noise_px2).value(),
            image_point(camera, pixel_2, noise_px2).value(),
            {}};
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Mismatches, testing::ValuesIn(methods::all_methods), method_name);

TEST_P(Mismatches, ThatRectificationAloneWouldLocate) {
  // View 2's ray is all but parallel to the rectified image plane: rectification's own point is a
  // million pixels from the images, where the first order says that such errors are usual.
  const geometry::Pose almost_forward{Eigen::Matrix3d::Identity(), Vector3d(-0.005, 0.002, -0.1)};
  const PointEstimate out =
      estimate_point(views_of(almost_forward, {456.968294, 459.043462}, {54.040843, 373.049914}),
                     {}, {}, GetParam());
  EXPECT_EQ(out.status, Status::target_lost) << out.reason;
  EXPECT_NEAR(out.residual_px, 237.94, 0.01);  // the optimal method's
  expect_filled(out, Filled::residual);
}

TEST_P(Mismatches, AreNeverLocatedWhereTheOptimalMethodSaysLost) {
  constexpr int pairs = test::trials(10'000, 2'000);
  Random random(61);
  const auto any_pixel = [&random] {
    return geometry::Pixel(random.uniform(0.0, 639.0), random.uniform(0.0, 479.0));
  };
  const geometry::Pose turned{geometry::about_y(0.3) * geometry::about_x(0.3),
                              Vector3d(-0.01, -0.01, -0.2)};
  int lost = 0, located = 0, other_residual = 0;
  for (int i = 0; i < pairs; ++i) {
    for (const geometry::Pose& pose : std::array{random_pose(Geometry::forward, random), turned,
                                                 random_pose(Geometry::head_turn, random)}) {
      const TwoViews views = views_of(pose, any_pixel(), any_pixel());
      const PointEstimate optimal = estimate_point(views, {}, {});
      const PointEstimate out = estimate_point(views, {}, {}, GetParam());
      if (optimal.status != Status::target_lost) continue;
      ++lost;
      located += out.status == Status::located ? 1 : 0;
      other_residual += std::abs(out.residual_px - optimal.residual_px) > 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(lost, 2 * pairs);  // of three
  EXPECT_EQ(located, 0);
  EXPECT_EQ(other_residual, 0);
}

}  // namespace
}  // namespace gazed::triangulation::mismatch_test
