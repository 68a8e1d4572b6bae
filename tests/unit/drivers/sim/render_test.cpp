#include "drivers/sim/render.hpp"

#include <Eigen/Core>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "agent/base/random.hpp"
#include "agent/geometry/head.hpp"

#include "picture.hpp"
#include "tests/unit/trials.hpp"

namespace gazed::sim::render_test {
namespace {

using testing::centroid;
using testing::crossing;
using testing::dark;
using testing::facing_surface;
using testing::looking;
using testing::Picture;
using testing::render;
using testing::small_camera;
using testing::tilted;
using testing::world_of;

constexpr double bright = 200.0;

/// The share of a pixel whose rays meet the world's surface, by many rays: a second way to the
/// same picture that knows nothing of edges.
double cast_coverage(const World& world, const geometry::CameraModel& camera,
                     const geometry::Pose& pose, int x, int y) {
  constexpr int rays = 20;
  int met = 0;
  for (int j = 0; j < rays; ++j)
    for (int i = 0; i < rays; ++i)
      if (hit(world, camera, pose,
              geometry::Pixel(x - 0.5 + (i + 0.5) / rays, y - 0.5 + (j + 0.5) / rays)))
        ++met;
  return met / double{rays * rays};
}

/// Compares every pixel that is not the same as all its neighbours.
void expect_cast_coverage(const World& world, const geometry::CameraModel& camera,
                          const geometry::Pose& pose) {
  // Rays quantise the area to about 1/20 at an edge along the rows, and the renderer takes curved
  // edges and corners as straight inside a pixel.
  constexpr double pixel_tolerance = 0.06;
  constexpr double mean_tolerance = 0.004;
  const Picture picture = render(world, camera, pose);
  double signed_sum = 0.0;
  int edges = 0;
  for (int y = 1; y + 1 < camera.height_px; ++y)
    for (int x = 1; x + 1 < camera.width_px; ++x) {
      bool edge = false;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) edge = edge || picture.at(x + i, y + j) != picture.at(x, y);
      if (!edge) continue;
      const double share = (picture.at(x, y) - dark) / (bright - dark);
      const double cast = cast_coverage(world, camera, pose, x, y);
      EXPECT_NEAR(share, cast, pixel_tolerance) << x << " " << y;
      signed_sum += share - cast;
      ++edges;
    }
  ASSERT_GT(edges, 20);
  EXPECT_NEAR(signed_sum / edges, 0.0, mean_tolerance);
}

TEST(Render, EdgesAgreeWithRayCasting) {
  const auto disc = facing_surface(Shape::disc, 0.5, 0.03, 0.02, 0.15, 0.15, bright);
  const auto square = facing_surface(Shape::rectangle, 0.4, -0.02, 0.0, 0.12, 0.09, bright);
  Surface ring = disc;
  ring.hole = 0.5;
  for (const bool distorted : {false, true}) {
    if (test::few_trials && !distorted) continue;
    const geometry::CameraModel camera = small_camera(distorted);
    for (const Surface& surface :
         {disc, square, ring, tilted(disc, 0.7, -0.4), tilted(square, -0.6, 0.5)}) {
      if (test::few_trials && surface.hole == 0.0 && surface.shape == Shape::disc) continue;
      if (!test::few_trials) expect_cast_coverage(world_of({surface}), camera, looking(0.0, 0.0));
      expect_cast_coverage(world_of({surface}), camera, looking(0.21, -0.13));
    }
  }
}

TEST(Render, CentroidOfASquareOnDiscIsItsProjectedCentre) {
  // A disc parallel to the image plane has its centroid at its centre when the lens is straight.
  constexpr double tolerance_px = 0.003;
  const geometry::CameraModel camera = small_camera(false);
  for (double left_m = -0.1; left_m < 0.11; left_m += 0.0437) {
    const auto disc = facing_surface(Shape::disc, 0.5, left_m, 0.5 * left_m, 0.08, 0.08, bright);
    const Picture picture = render(world_of({disc}), camera, looking(0.0, 0.0));
    const geometry::Pixel expected = *geometry::project(camera, looking(0.0, 0.0) * disc.centre_m);
    const geometry::Pixel found = centroid(picture, dark);
    EXPECT_NEAR(found.x(), expected.x(), tolerance_px);
    EXPECT_NEAR(found.y(), expected.y(), tolerance_px);
  }
}

TEST(Render, CornersAndEdgesLieWhereProjectPutsThem) {
  constexpr double tolerance_px = 0.02;
  for (const bool distorted : {false, true}) {
    const geometry::CameraModel camera = small_camera(distorted);
    for (const auto& [yaw, pitch] : {std::pair{0.0, 0.0}, {0.2, -0.1}, {-0.15, 0.2}}) {
      const geometry::Pose pose = looking(yaw, pitch);
      const auto square = facing_surface(Shape::rectangle, 0.5, 0.0, 0.0, 0.2, 0.2, bright);
      const Picture picture = render(world_of({square}), camera, pose);
      // On one row, the left edge: the point of the edge that project() puts on that row.
      const auto on_edge = [&](double v) {
        return *geometry::project(
            camera,
            pose * (square.centre_m - square.half_width_m * square.right + v * square.down));
      };
      const int row = static_cast<int>(std::lround(on_edge(0.0).y()));
      double v = 0.0;
      for (int i = 0; i < 30; ++i)  // secant on a nearly linear function
        v += (row - on_edge(v).y()) / ((on_edge(v + 1e-4).y() - on_edge(v).y()) / 1e-4);
      ASSERT_NEAR(on_edge(v).y(), row, 1e-6);
      const double expected = on_edge(v).x();
      if (expected < 3.0) continue;
      // A slanted edge spreads over two or three pixels: sum the coverage up to inside the square.
      const int inside = static_cast<int>(expected) + 6;
      double covered = 0.0;
      for (int x = 0; x <= inside; ++x) covered += (picture.at(x, row) - dark) / (bright - dark);
      EXPECT_NEAR(inside + 0.5 - covered, expected, tolerance_px) << yaw << " " << pitch;
    }
  }
}

TEST(Render, ATenthOfAPixelMovesATenthOfTheLight) {
  constexpr double tolerance = 1e-3;  // of a pixel
  const geometry::CameraModel camera = small_camera(false);
  const double pixel_m = 0.5 / camera.focal_px.x();
  double before = 0.0;
  for (int i = 0; i <= 20; ++i) {
    auto square = facing_surface(Shape::rectangle, 0.5, 0.0, 0.0, 0.1, 0.1, bright);
    square.centre_m.y() -= 0.1 * i * pixel_m;  // to the right
    const Picture picture = render(world_of({square}), camera, looking(0.0, 0.0));
    double left_half = 0.0;
    for (int x = 0; x < 78; ++x) left_half += (picture.at(x, 60) - dark) / (bright - dark);
    if (i > 0) {
      EXPECT_NEAR(before - left_half, 0.1, tolerance) << i;
    }
    before = left_half;
  }
}

TEST(Render, NearerHidesFartherInWhateverOrder) {
  const geometry::CameraModel camera = small_camera(false);
  const auto near = facing_surface(Shape::disc, 0.4, 0.0, 0.0, 0.1, 0.1, bright);
  const auto far = facing_surface(Shape::rectangle, 0.8, 0.0, 0.0, 3.0, 3.0, 100.0);
  const Picture one = render(world_of({near, far}), camera, looking(0.0, 0.0));
  const Picture other = render(world_of({far, near}), camera, looking(0.0, 0.0));
  EXPECT_EQ(one.rgb, other.rgb);
  EXPECT_FLOAT_EQ(one.at(78, 61), 200.0F);
  EXPECT_FLOAT_EQ(one.at(10, 10), 100.0F);
}

TEST(Render, InOnePlaneTheLaterIsOnTop) {
  const geometry::CameraModel camera = small_camera(false);
  const auto wall =
      tilted(facing_surface(Shape::rectangle, 0.5, 0.0, 0.0, 3.0, 3.0, 100.0), 0.5, 0.1);
  const auto paper = tilted(facing_surface(Shape::disc, 0.5, 0.0, 0.0, 0.1, 0.1, bright), 0.5, 0.1);
  for (const double yaw : {-0.2, 0.0, 0.13}) {
    const Picture picture = render(world_of({wall, paper}), camera, looking(yaw, 0.0));
    const geometry::Pixel centre = *geometry::project(camera, looking(yaw, 0.0) * paper.centre_m);
    EXPECT_FLOAT_EQ(picture.at(static_cast<int>(centre.x()) + 2, static_cast<int>(centre.y()) - 2),
                    200.0F);
  }
  const Picture hidden = render(world_of({paper, wall}), camera, looking(0.0, 0.0));
  for (const float value : hidden.rgb) ASSERT_FLOAT_EQ(value, 100.0F);
}

TEST(Render, SurfacesThatMeetLeaveNoGap) {
  constexpr float tolerance = 0.01F;
  const geometry::CameraModel camera = small_camera(false);
  // Two walls of one colour that meet at a corner of the room, ahead and a little to the left.
  auto ahead = facing_surface(Shape::rectangle, 0.8, -0.9, 0.0, 2.0, 2.0, 150.0);
  auto left = ahead;
  left.centre_m = {-0.2, 0.1, 0.0};
  left.right = Eigen::Vector3d::UnitX();
  const Picture picture = render(world_of({ahead, left}), camera, looking(0.05, 0.0));
  for (const float value : picture.rgb) ASSERT_NEAR(value, 150.0F, tolerance);
}

TEST(Render, AFloorThatReachesBehindTheCamera) {
  Surface floor;
  floor.centre_m = {0.0, 0.0, -0.5};
  floor.right = -Eigen::Vector3d::UnitY();
  floor.down = -Eigen::Vector3d::UnitX();
  floor.half_width_m = floor.half_height_m = 50.0;
  floor.texture.colour = {bright, bright, bright};
  const geometry::CameraModel camera = small_camera(false);
  const Picture picture = render(world_of({floor}), camera, looking(0.0, 0.0));
  // Its end, 50 m ahead and 0.5 m below, is 1.5 px under the horizon.
  EXPECT_FLOAT_EQ(picture.at(80, 60), 50.0F);
  EXPECT_FLOAT_EQ(picture.at(80, 65), 200.0F);
  EXPECT_FLOAT_EQ(picture.at(0, 119), 200.0F);
}

TEST(Render, WhatIsBehindOrSeenFromItsEdgeIsNotDrawn) {
  const geometry::CameraModel camera = small_camera(false);
  auto edge_on = facing_surface(Shape::rectangle, 0.5, 0.0, 0.0, 0.5, 0.5, bright);
  edge_on.right = Eigen::Vector3d::UnitX();
  const auto behind = facing_surface(Shape::rectangle, -0.5, 0.0, 0.0, 0.5, 0.5, bright);
  auto around = facing_surface(Shape::rectangle, 0.0, 0.0, 0.0, 0.5, 0.5, bright);
  const Picture picture = render(world_of({edge_on, behind, around}), camera, looking(0.0, 0.0));
  for (const float value : picture.rgb) ASSERT_FLOAT_EQ(value, 50.0F);
}

TEST(Render, TwoHeadAnglesSeeTheSameDisc) {
  // The disc is small, so that its centroid is its centre's projection but for a^2/Z^2 terms.
  constexpr double tolerance_px = 0.03;
  const geometry::HeadGeometry head{{0, 0, 0.1265}, {0.0539, 0, 0.0679}, {0.03, 0.05, -0.02}, {}};
  const geometry::CameraModel camera = small_camera(false);
  auto disc = facing_surface(Shape::disc, 0.7, 0.02, 0.2, 0.03, 0.03, bright);
  for (const geometry::HeadAngles angles :
       {geometry::HeadAngles{0.0, 0.0}, {0.15, 0.1}, {-0.2, -0.1}, {0.3, -0.2}}) {
    const geometry::Pose pose = geometry::cam_from_torso(head, angles);
    const geometry::Pixel expected = *geometry::project(camera, pose * disc.centre_m);
    ASSERT_TRUE(camera.contains(expected, 8.0));
    const geometry::Pixel found = centroid(render(world_of({disc}), camera, pose), dark);
    EXPECT_NEAR(found.x(), expected.x(), tolerance_px);
    EXPECT_NEAR(found.y(), expected.y(), tolerance_px);
  }
}

TEST(Render, RefusesALensThatCannotBeUndone) {
  geometry::CameraModel camera = small_camera(false);
  camera.distortion = {-3.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(Renderer{camera}, std::invalid_argument);
}

/// The grey of the only surface that a pixel and its surroundings see; none where there are
/// several.
std::optional<double> only_grey(const std::vector<Surface>& surfaces,
                                const geometry::CameraModel& camera, const geometry::Pose& pose,
                                int x, int y) {
  std::optional<double> grey;
  for (const double dy : {-1.5, 0.0, 1.5})
    for (const double dx : {-1.5, 0.0, 1.5}) {
      double nearest_m = 1e9, here = testing::dark;
      for (const Surface& surface : surfaces) {
        const auto met = hit(world_of({surface}), camera, pose, geometry::Pixel(x + dx, y + dy));
        if (!met || met->range_m >= nearest_m) continue;
        nearest_m = met->range_m;
        here = surface.texture.colour[0];
      }
      if (grey && *grey != here) return std::nullopt;
      grey = here;
    }
  return grey;
}

TEST(Render, EveryPixelShowsTheNearestOfManySurfaces) {
  constexpr int worlds = test::trials(20, 5), surfaces_each = 8;
  // A tenth of what two surfaces differ by: a corner's tip may lie between the rays that are cast.
  constexpr double tolerance = 2.0;
  base::Random random(5, 1);
  int compared = 0;
  for (int i = 0; i < worlds; ++i) {
    std::vector<Surface> surfaces;
    for (int k = 0; k < surfaces_each; ++k) {
      const double ahead_m = 1.0 + 2.0 * random.uniform(), left_m = random.symmetric(),
                   up_m = random.symmetric(), size_m = 0.3 + 3.0 * random.uniform();
      const Surface facing =
          facing_surface(random.uniform() < 0.7 ? Shape::rectangle : Shape::disc, ahead_m, left_m,
                         up_m, size_m, size_m * (0.5 + random.uniform()), 10.0 + 20.0 * k);
      // Up to 0.9 rad: at a steep one's corners a pixel's edges are not straight.
      const double about_vertical_rad = 0.9 * random.symmetric();
      surfaces.push_back(tilted(facing, about_vertical_rad, 0.9 * random.symmetric()));
    }
    const geometry::CameraModel camera = small_camera(i % 2 == 1);
    const geometry::Pose pose = looking(0.3 * random.symmetric(), 0.2);
    const Picture picture = render(world_of(surfaces), camera, pose);
    for (int y = 2; y < camera.height_px - 2; y += 5)
      for (int x = 2; x < camera.width_px - 2; x += 5) {
        const auto grey = only_grey(surfaces, camera, pose, x, y);
        if (!grey) continue;
        ++compared;
        ASSERT_NEAR(static_cast<double>(picture.at(x, y)), *grey, tolerance)
            << i << " " << x << " " << y;
      }
  }
  EXPECT_GT(compared, worlds * 300);
}

}  // namespace
}  // namespace gazed::sim::render_test
