// Highlights: the lamp mirrored where the surface's normal halves the angle between it and the
// camera, so that they move when the camera does.
#include "drivers/sim/paint.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "picture.hpp"

namespace gazed::sim::paint_test {
namespace {

using namespace testing;

geometry::Pixel brightest(const Picture& picture) {
  geometry::Pixel best = geometry::Pixel::Zero();
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      if (picture.at(x, y) > picture.at(static_cast<int>(best.x()), static_cast<int>(best.y())))
        best = geometry::Pixel(x, y);
  return best;
}

geometry::Pose from(const Eigen::Vector3d& eye_m) {
  geometry::Pose pose = looking(0.0, 0.0);
  pose.translation = -(pose.rotation * eye_m);
  return pose;
}

TEST(Paint, AFlatHighlightIsWhereAMirrorWouldShowTheLamp) {
  const geometry::CameraModel camera = small_camera(false);
  Surface wall = facing_surface(Shape::rectangle, 0.5, 0.0, 0.0, 0.8, 0.8, 100.0);
  wall.finish = {.shading = 0.0, .gloss = 0.5, .shininess = 256};
  World world = world_of({wall});
  world.lamp_m = {-0.5, 0.2, 0.1};
  geometry::Pixel before = geometry::Pixel::Zero();
  for (const Eigen::Vector3d& eye_m : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, -0.05, 0.02)}) {
    const geometry::Pose pose = from(eye_m);
    const Picture picture = render(world, camera, pose);
    // The lamp's mirror image behind the wall; its ray meets the wall.
    const Eigen::Vector3d mirrored_m(1.5, 0.2, 0.1);
    const Eigen::Vector3d at_m = eye_m + 0.5 / 1.5 * (mirrored_m - eye_m);
    const geometry::Pixel expected = *geometry::project(camera, pose * at_m);
    const geometry::Pixel seen = brightest(picture);
    EXPECT_LT((seen - expected).norm(), 1.0);
    EXPECT_NEAR(picture.at(static_cast<int>(seen.x()), static_cast<int>(seen.y())), 227.5F, 1.0F);
    EXPECT_GT((seen - before).norm(), 1.0);
    before = seen;
  }
}

TEST(Paint, ABallsHighlightIsWhereItsNormalHalvesTheAngleToTheLamp) {
  const geometry::CameraModel camera = small_camera(false);
  Surface ball = facing_surface(Shape::ball, 0.5, 0.0, 0.0, 0.3, 0.3, 100.0);
  ball.finish = {.shading = 0.0, .gloss = 0.5, .shininess = 128};
  World world = world_of({ball});
  world.lamp_m = {-0.5, 0.6, 0.8};
  const Eigen::Vector3d centre_m(0.5, 0.0, 0.0);
  geometry::Pixel before_off = geometry::Pixel::Zero();
  for (const Eigen::Vector3d& eye_m : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, -0.1, 0.05)}) {
    const geometry::Pose pose = from(eye_m);
    const geometry::Pixel seen = brightest(render(world, camera, pose));
    const Eigen::Vector3d ray =
        (pose.rotation.transpose() * geometry::normalise(camera, seen)->homogeneous()).normalized();
    const Eigen::Vector3d to_centre = centre_m - eye_m;
    const double along_m = ray.dot(to_centre);
    const double depth_m = std::sqrt(0.15 * 0.15 - (to_centre.squaredNorm() - along_m * along_m));
    const Eigen::Vector3d at_m = eye_m + (along_m - depth_m) * ray;
    const Eigen::Vector3d half =
        ((eye_m - at_m).normalized() + (world.lamp_m - at_m).normalized()).normalized();
    constexpr double one_pixel = 0.05;  // on so near a ball
    EXPECT_GT(half.dot((at_m - centre_m).normalized()), std::cos(one_pixel));
    // It does not stick to the surface, nor to the outline.
    const geometry::Pixel off = seen - *geometry::project(camera, pose * centre_m);
    EXPECT_GT((off - before_off).norm(), 1.0);
    before_off = off;
  }
}

}  // namespace
}  // namespace gazed::sim::paint_test
