// What a match says beside pixel_2: how large the object has become, and in which direction its
// place is not known; and that it says it again.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <gmock/gmock.h>

#include "agent/tracking/registration.hpp"

#include "bench.hpp"

namespace gazed::tracking::match_test {
namespace {

using testing::HasSubstr;

class MatchTest : public testing::Test {
 protected:
  Bench bench;
  const Capture noisy{.noise_levels = 2.0};
};

TEST_F(MatchTest, ScaleIsTheRatioOfDistances) {
  const geometry::HeadAngles move{0.1, 0.25};  // the camera goes forward and down
  const Scene scene = bench.scene(Object::disc, 60.0, 0.2, {0.1, 0.4});
  Registration registration = bench.registration();
  const Shot shot_1 = expose(look(scene, {}), noisy, bench.random);
  const Shot shot_2 = expose(look(scene, move), noisy, bench.random);
  const auto pixel_1 = registration.choose_target(shot_1.view(), scene.object_px);
  ASSERT_TRUE(pixel_1);
  const RegistrationResult result = registration.find(shot_2.view());
  ASSERT_TRUE(result.match) << result.reason;
  const Eigen::Vector3d point =
      scene.range_m * geometry::normalise(scene.camera, *pixel_1)->homogeneous().normalized();
  const Eigen::Vector3d eye = geometry::origin(geometry::cam2_from_cam1(scene.head, {}, move));
  // Depths along camera 1's axis, as a facing plane's size goes; slopes of the fit cost 1 %.
  EXPECT_NEAR(result.match->scale, point.z() / (point.z() - eye.z()), 0.01);
  EXPECT_GT(result.match->scale, 1.05);
}

// It could be anywhere along itself. At 5 levels noise alone has slopes along the edge.
TEST_F(MatchTest, AnEdgeAloneIsRefusedWithWords) {
  for (const double noise_levels : {0.0, 2.0, 5.0}) {
    for (const double slant : {0.0, 0.1, 0.7}) {
      Scene scene = bench.scene(Object::square, 1.0, 0.4, moves[0]);
      scene.present = false;
      scene.wall = [slant](double u, double v) {
        return u > slant * v ? Colour(40, 40, 160) : Colour(200, 200, 200);
      };
      Registration registration = bench.registration();
      const Shot shot = expose(look(scene, {}), {.noise_levels = noise_levels}, bench.random);
      EXPECT_FALSE(registration.choose_target(shot.view(), scene.object_px))
          << noise_levels << " levels, slant " << slant;
      EXPECT_THAT(registration.refusal(), HasSubstr("one direction"));
      EXPECT_THAT(registration.find(shot.view()).reason, HasSubstr("one direction"));
    }
  }
}

TEST_F(MatchTest, TheSameInputGivesTheSameBits) {
  const geometry::HeadAngles move = moves[2];
  const Scene scene = bench.scene(Object::textured, 40.0, 0.4, move);
  const Shot shot_1 = expose(look(scene, {}), noisy, bench.random);
  const Shot shot_2 = expose(look(scene, move), noisy, bench.random);
  Registration used = bench.registration(), fresh = bench.registration();
  static_cast<void>(used.choose_target(shot_2.view(), scene.object_px));
  static_cast<void>(used.find(shot_1.view()));
  const auto pixel_1 = used.choose_target(shot_1.view(), scene.object_px);
  ASSERT_EQ(pixel_1, fresh.choose_target(shot_1.view(), scene.object_px));
  const auto once = used.find(shot_2.view()), again = fresh.find(shot_2.view());
  ASSERT_TRUE(once.match && again.match);
  EXPECT_EQ(once.match->pixel_2, again.match->pixel_2);
  EXPECT_EQ(once.match->covariance_px2, again.match->covariance_px2);
}

}  // namespace
}  // namespace gazed::tracking::match_test
