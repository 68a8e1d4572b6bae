#include "tests/benchmarks/grey_room.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace gazed::benchmarks {

namespace {

constexpr double small_object_m = 0.06, large_object_m = 0.10, large_from_m = 0.5;

// A papered wall's tile is 730 px wide, so that it does not repeat inside a frame (a pixel is range
// / 608).
constexpr double tile_by_range = 1.2;

}  // namespace

double object_size_m(double range_m) {
  return range_m < large_from_m ? small_object_m : large_object_m;
}

sim::Texture photographic(base::Random& random, double range_m) {
  sim::Texture texture;
  texture.pattern = sim::Pattern::leaves;
  const double grey = random.uniform(90.0, 150.0);
  texture.colour = {grey * random.uniform(0.95, 1.05), grey, grey * random.uniform(0.95, 1.05)};
  texture.contrast = random.uniform(15.0, 30.0);
  texture.tile_m = tile_by_range * range_m;
  texture.seed = 1 + static_cast<std::uint32_t>(random.uniform() * 1e6);
  return texture;
}

sim::Appearance draw_red_object(base::Random& random, double range_m) {
  sim::Appearance object;
  object.shape = random.uniform() < 0.5 ? sim::Shape::disc : sim::Shape::rectangle;
  const double size_m = object_size_m(range_m);
  object.size_m = {size_m, size_m};
  object.texture.pattern = sim::Pattern::natural;  // print that is not quite even
  object.texture.colour = {random.uniform(180, 210), random.uniform(15, 40),
                           random.uniform(15, 40)};
  object.texture.contrast = 3.0;
  object.texture.tile_m = 0.1;
  constexpr std::array<sim::Mark, 3> marks{sim::Mark::none, sim::Mark::ring, sim::Mark::cross};
  object.mark = one_of(random, std::span<const sim::Mark>(marks));
  object.mark_colour = {128, 10, 16};
  return object;
}

void add_room(sim::Scene& scene, base::Random& random, double ahead_m) {
  const double half_width_m = random.uniform(1.2, 2.5);
  // From where each is mostly seen.
  const std::array<double, 5> ranges_m{ahead_m, half_width_m, half_width_m, 1.0, 2.0};
  const std::array<sim::PlacedPlane, 5> walls = room_walls(half_width_m, ahead_m);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    scene.planes.push_back(walls[i]);
    scene.planes.back().appearance.texture = photographic(random, ranges_m[i]);
  }
}

void add_clutter(sim::Scene& scene, base::Random& random, const Camera1& camera,
                 const Eigen::Vector3d& target_direction, double target_radius_rad,
                 double ahead_m) {
  constexpr int dull_things = 6;
  for (int i = 0; i <= dull_things; ++i) {
    const bool stands_out = i == dull_things;
    const double range_m = random.uniform(0.4, 0.9 * ahead_m);
    const double radius_rad = random.uniform(0.04, 0.10);
    Eigen::Vector3d direction;
    do {
      direction = draw_direction(random, Region::frame, camera, radius_rad, range_m);
    } while (std::acos(direction.dot(target_direction)) < 1.5 * (radius_rad + target_radius_rad));
    const Eigen::Vector3d normal = draw_normal(random, camera, 0.5);
    const double size_m = 2.0 * range_m * radius_rad;
    sim::PlacedPlane thing = plane(camera.centre_m() + range_m * direction, normal,
                                   {size_m, size_m}, photographic(random, range_m));
    thing.target = stands_out;
    if (stands_out) {
      thing.appearance.shape = sim::Shape::disc;
      thing.appearance.texture.colour = {40, 60, 170};
    } else {
      thing.appearance.texture.colour = {random.uniform(80, 160), random.uniform(80, 160),
                                         random.uniform(80, 160)};
    }
    scene.planes.push_back(thing);
  }
}

}  // namespace gazed::benchmarks
