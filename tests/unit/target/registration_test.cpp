#include "agent/target/registration.hpp"

#include <gmock/gmock.h>

#include "agent/geometry/robot.hpp"

#include "scene.hpp"

namespace gazed::test {
namespace {

// The goal for clean images with camera noise: the range error at 1 m after a 0.1 rad move is then
// below that of the joints.
constexpr double error_max_px = 0.05;

TEST(Registration, FindsAPlainDiscOnAWall) {
  const RobotProfile robot = *robot_profile("nao-v6");
  Scene scene;
  scene.camera = robot.camera;
  scene.head = robot.head;
  const HeadAngles move{0.1, 0.1};
  std::mt19937_64 random(1);
  const Shot first = render(scene, {}, {.noise_levels = 2.0}, random);
  const Shot second = render(scene, move, {.noise_levels = 2.0}, random);
  Registration registration({}, robot.camera, robot.head, robot.uncertainty);
  const auto pixel_1 = registration.choose_target(first.view(), scene.object_px + Pixel(9, -12));
  ASSERT_TRUE(pixel_1);
  EXPECT_TRUE(on_object(scene, *pixel_1));
  const RegistrationResult result = registration.find(second.view());
  ASSERT_TRUE(result.match) << result.reason;
  const Pixel truth = true_pixel_2(scene, move, *pixel_1);
  EXPECT_LT((result.match->pixel_2 - truth).norm(), error_max_px);
}

}  // namespace
}  // namespace gazed::test
