// A print on an object, and a thing in front of it, which looks the same in one picture.
#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "bench.hpp"

namespace gazed::tracking::mark_test {
namespace {

constexpr Capture noisy{.noise_levels = 2.0};
constexpr double range_m = 0.3, print_px = 45.0, board_px = 85.0;
// Of one draw of the noise, with background and board behind the outline.
constexpr double error_max_px = 0.2;

const Colour orange(200, 120, 50), yellow(210, 190, 60), grey(40, 40, 45);

class MarkTest : public testing::TestWithParam<geometry::HeadAngles> {
 protected:
  /// An orange disc, and a yellow one on the wall behind it, which is as far away as told.
  [[nodiscard]] Scene disc_in_front_of(double wall_behind_m) const {
    Scene scene = bench.scene(Object::disc, print_px, range_m, GetParam());
    scene.paint = [](double, double) { return orange; };
    scene.wall_behind_m = wall_behind_m;
    const double f = scene.camera.focal_px.mean();
    const double board_m = board_px / f * (range_m + wall_behind_m);
    // They have one centre in look 1.
    const auto direction = geometry::normalise(scene.camera, scene.object_px).value();
    const Eigen::Vector2d off_m = wall_behind_m * direction;
    scene.wall = [=](double u, double v) {
      return std::hypot(u - off_m.x(), v - off_m.y()) < board_m ? yellow : grey;
    };
    return scene;
  }

  [[nodiscard]] RegistrationResult find(const Scene& scene) {
    const Shot shot_1 = expose(look(scene, scene.head_1), noisy, bench.random);
    chosen = registration.choose_target(shot_1.view(), scene.object_px);
    mark = registration.mark();
    const Shot shot_2 = expose(look(scene, GetParam()), noisy, bench.random);
    return registration.find(shot_2.view());
  }

  Bench bench;
  Registration registration = bench.registration();
  std::optional<geometry::Pixel> chosen, mark;
};

TEST_P(MarkTest, AThingInFrontOfABoardIsTheTarget) {
  const Scene scene = disc_in_front_of(0.1);
  const RegistrationResult result = find(scene);
  ASSERT_TRUE(chosen && mark);
  EXPECT_GT(registration.half_size_px(), 0.0);
  ASSERT_TRUE(result.match) << result.reason;
  EXPECT_EQ(result.match->pixel_1, *mark);
  EXPECT_LT((result.match->pixel_2 - true_pixel_2(scene, GetParam(), *mark)).norm(), error_max_px);
  EXPECT_LT(registration.half_size_px(), board_px) << "it is the target now";
  EXPECT_FALSE(registration.mark());
}

TEST_P(MarkTest, APrintIsNot) {
  const Scene scene = disc_in_front_of(0.0);
  const RegistrationResult result = find(scene);
  ASSERT_TRUE(chosen && mark);
  ASSERT_TRUE(result.match) << result.reason;
  EXPECT_EQ(result.match->pixel_1, *chosen);
  EXPECT_LT((result.match->pixel_2 - true_pixel_2(scene, GetParam(), *chosen)).norm(),
            error_max_px);
  EXPECT_GT(registration.half_size_px(), board_px);
  EXPECT_FALSE(registration.mark());
}

// A print on a ball is nearer than the ball's outline, by up to its radius.
TEST_P(MarkTest, APrintOnABallIsNot) {
  Scene scene = bench.scene(Object::disc, board_px, range_m, GetParam());
  scene.ball = true;
  const double print_m = print_px / board_px * scene.half_size_m;
  scene.paint = [=](double u, double v) { return std::hypot(u, v) < print_m ? orange : yellow; };
  scene.wall_colour = grey;
  const RegistrationResult result = find(scene);
  ASSERT_TRUE(chosen && mark);
  ASSERT_TRUE(result.match) << result.reason;
  EXPECT_EQ(result.match->pixel_1, *chosen);
}

INSTANTIATE_TEST_SUITE_P(Moves, MarkTest, testing::ValuesIn(moves),
                         [](const auto& move) { return "Move" + std::to_string(move.index); });

}  // namespace
}  // namespace gazed::tracking::mark_test
