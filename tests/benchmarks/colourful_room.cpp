#include "tests/benchmarks/colourful_room.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "tests/benchmarks/grey_room.hpp"

namespace gazed::benchmarks {

namespace {

using Levels = std::array<double, 3>;

// Papers and prints share a few tiles: to make one costs as much as drawing a frame.
constexpr double tile_seeds = 2.0;
// The camera is up to 90 mm in front of the neck: between two looks it moves by no more than this.
constexpr double camera_moves_m = 0.06;

/// Hue, saturation, value, each 0 to 1 (Smith 1978).
Levels colour_of(double hue, double saturation, double value) {
  const auto channel = [&](double turned) {
    const double sixths = std::fmod(6.0 * (hue - std::floor(hue)) + turned, 6.0);
    const double off = std::clamp(std::min(sixths, 4.0 - sixths), 0.0, 1.0);
    return 255.0 * value * (1.0 - saturation * off);
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

/// Half of what is in a room is nearly grey, a third is pale.
Levels draw_colour(base::Random& random, const Palette& palette) {
  const double kind = random.uniform(), hue = palette.hue + 0.25 * random.symmetric();
  const double saturation = kind < 0.5    ? random.uniform(0.0, 0.2)
                            : kind < 0.85 ? random.uniform(0.2, 0.4)
                                          : random.uniform(0.5, 0.8);
  return colour_of(hue, saturation, random.uniform(0.4, 0.95));
}

/// What walls are painted with.
Levels wall_colour(base::Random& random, const Palette& palette) {
  const double hue = palette.hue + 0.25 * random.symmetric(), saturation = random.uniform(0.0, 0.3);
  return colour_of(hue, saturation, random.uniform(0.6, 0.9));
}

std::uint32_t tile_seed(base::Random& random) {
  return 1 + static_cast<std::uint32_t>(random.uniform() * tile_seeds);
}

sim::Texture paint(const Levels& colour) {
  sim::Texture texture;
  texture.colour = colour;
  return texture;
}

sim::Texture tiled(sim::Pattern pattern, const Levels& colour, double contrast, double tile_m,
                   base::Random& random) {
  sim::Texture texture = paint(colour);
  texture.pattern = pattern;
  texture.contrast = contrast;
  texture.tile_m = tile_m;
  texture.seed = tile_seed(random);
  return texture;
}

/// A print or a fabric of this size: even, with a pattern, chequered, or a picture.
sim::Texture draw_print(base::Random& random, const Palette& palette, double size_m) {
  const double kind = random.uniform();
  if (kind < 0.35) return paint(draw_colour(random, palette));
  if (kind < 0.55) {
    const Levels colour = draw_colour(random, palette);
    const double contrast = random.uniform(5.0, 20.0);
    return tiled(sim::Pattern::leaves, colour, contrast, size_m * random.uniform(0.7, 3.0), random);
  }
  if (kind < 0.8) {
    const double grey = random.uniform(90.0, 160.0), contrast = random.uniform(10.0, 30.0);
    return tiled(sim::Pattern::collage, {grey, grey, grey}, contrast,
                 size_m * random.uniform(0.7, 3.0), random);
  }
  sim::Texture texture = paint(draw_colour(random, palette));
  texture.pattern = sim::Pattern::checker;
  texture.colour_2 = draw_colour(random, palette);
  texture.cell_m = size_m / random.uniform(1.0, 8.0);
  return texture;
}

/// Painted, or papered, in the light of a window or a lamp.
sim::Texture draw_wall(base::Random& random, const Palette& palette, double range_m,
                       Photographs photographs) {
  sim::Texture texture;
  if (!photographs.empty()) {
    texture.pattern = sim::Pattern::image;
    texture.image = one_of(random, photographs);
    return texture;
  }
  const Levels colour = wall_colour(random, palette);
  if (random.uniform() < 0.5)
    texture = tiled(sim::Pattern::natural, colour, random.uniform(1.0, 3.0), 0.5, random);
  else
    texture = tiled(sim::Pattern::leaves, colour, random.uniform(5.0, 20.0), 1.2 * range_m, random);
  texture.gradient = {0.2 * random.symmetric(), 0.2 * random.symmetric()};
  return texture;
}

sim::Appearance draw_thing(base::Random& random, const Palette& palette, double size_m) {
  sim::Appearance thing;
  thing.shape = random.uniform() < 0.25 ? sim::Shape::disc : sim::Shape::rectangle;
  const double aspect = std::exp(0.8 * random.symmetric());
  thing.size_m = {size_m * std::sqrt(aspect), size_m / std::sqrt(aspect)};
  thing.texture = draw_print(random, palette, size_m);
  return thing;
}

double half_diagonal_m(const sim::Appearance& appearance) {
  return 0.5 * std::hypot(appearance.size_m[0], appearance.size_m[1]);
}

/// A part of a larger plane, painted on it: across and up from its centre.
sim::PlacedPlane part_of(const sim::PlacedPlane& whole, double across_m, double up_m,
                         std::array<double, 2> size_m, const sim::Texture& texture) {
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(whole.normal).normalized();
  const Eigen::Vector3d up = whole.normal.normalized().cross(across);
  return plane(whole.centre_m + across_m * across + up_m * up, whole.normal, size_m, texture);
}

/// Books side by side on a wall, their feet in line.
void add_books(sim::Scene& scene, base::Random& random, const Palette& palette,
               const sim::PlacedPlane& wall, double from_m, double foot_m) {
  const double width_m = random.uniform(0.4, 1.0);
  double across_m = from_m;
  while (across_m < from_m + width_m) {
    const double thickness_m = random.uniform(0.02, 0.07), height_m = random.uniform(0.18, 0.32);
    scene.planes.push_back(part_of(wall, across_m + 0.5 * thickness_m, foot_m + 0.5 * height_m,
                                   {thickness_m, height_m}, paint(draw_colour(random, palette))));
    across_m += thickness_m;
  }
}

/// Cupboards, doors, posters and books along a wall of the room.
void furnish(sim::Scene& scene, base::Random& random, const Palette& palette,
             const sim::PlacedPlane& wall) {
  const double half_m = 0.5 * std::min(wall.appearance.size_m[0], 6.0);
  constexpr int pieces = 4;
  for (int i = 0; i < pieces; ++i) {
    const double across_m = half_m * random.symmetric();
    const double width_m = random.uniform(0.3, 1.2), height_m = random.uniform(0.4, 1.6);
    const double foot_m = -0.5 * wall.appearance.size_m[1];
    scene.planes.push_back(part_of(wall, across_m, foot_m + 0.5 * height_m, {width_m, height_m},
                                   draw_print(random, palette, width_m)));
    const double poster_m = random.uniform(0.2, 0.7);
    scene.planes.push_back(part_of(wall, half_m * random.symmetric(), 0.7 * random.symmetric(),
                                   {poster_m, 1.4 * poster_m},
                                   draw_print(random, palette, poster_m)));
  }
  add_books(scene, random, palette, wall, half_m * random.symmetric(), 0.5 * random.symmetric());
}

/// A direction this far from another.
Eigen::Vector3d beside(base::Random& random, const Eigen::Vector3d& direction, double off_rad) {
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(direction).normalized();
  const Eigen::Vector3d up = direction.cross(across);
  const double turn = 6.283185307179586 * random.uniform();
  return std::cos(off_rad) * direction +
         std::sin(off_rad) * (std::cos(turn) * across + std::sin(turn) * up);
}

/// Its far edge is at the wall that the object hangs on.
void add_table(sim::Scene& scene, base::Random& random, const Palette& palette,
               const Target& target, bool on_wall) {
  const Eigen::Vector3d& object_m = target.object.centre_m;
  const double top_z_m =
      object_m.z() - half_diagonal_m(target.object.appearance) - random.uniform(0.005, 0.03);
  if (top_z_m < floor_z_m + 0.1) return;
  const double depth_m = random.uniform(0.4, 0.8), width_m = random.uniform(0.5, 1.2);
  const double middle_m = object_m.x() + depth_m * (on_wall ? -0.5 : random.uniform(-0.2, 0.4));
  const double left_m = object_m.y() + 0.2 * random.symmetric();
  scene.planes.push_back(plane({middle_m, left_m, top_z_m}, Eigen::Vector3d::UnitZ(),
                               {width_m, depth_m}, draw_print(random, palette, 0.5)));
}

}  // namespace

sim::Appearance draw_colourful_object(base::Random& random, const Palette& palette,
                                      double range_m) {
  sim::Appearance object = draw_red_object(random, range_m);
  if (object.shape == sim::Shape::rectangle) object.size_m[1] *= random.uniform(0.7, 1.4);
  const double hue = palette.hue + 0.5 + 0.2 * random.symmetric();
  const bool pale = random.uniform() < 1.0 / 3.0;
  const double saturation = pale ? random.uniform(0.4, 0.55) : random.uniform(0.6, 0.95);
  object.texture.colour = colour_of(hue, saturation, random.uniform(0.5, 0.95));
  object.texture.contrast = random.uniform(0.5, 6.0);
  const double darker = random.uniform(0.3, 0.8);
  for (std::size_t c = 0; c < 3; ++c) object.mark_colour[c] = darker * object.texture.colour[c];
  return object;
}

void add_wall_behind(sim::Scene& scene, base::Random& random, const Palette& palette,
                     const Target& target, Photographs photographs) {
  const double size_m = 3.0 + 3.0 * target.range_m;
  sim::PlacedPlane wall = plane(target.object.centre_m, target.object.normal, {size_m, size_m},
                                draw_wall(random, palette, target.range_m, {}));
  scene.planes.push_back(wall);
  if (!photographs.empty()) {
    // A little wider than the view, 4:3.
    const double width_m = 1.6 * target.range_m;
    scene.planes.push_back(plane(wall.centre_m, wall.normal, {width_m, 0.75 * width_m},
                                 draw_wall(random, palette, target.range_m, photographs)));
  }
  const double object_m = half_diagonal_m(target.object.appearance);
  const int posters = 4 + static_cast<int>(5.0 * random.uniform());
  for (int i = 0; i < posters; ++i) {
    const double poster_m = object_m * random.uniform(1.5, 5.0);
    sim::Appearance poster = draw_thing(random, palette, poster_m);
    const double least_m = 1.05 * (object_m + half_diagonal_m(poster));
    const double away_m = least_m + 0.6 * target.range_m * random.uniform();
    const double turn = 6.283185307179586 * random.uniform();
    sim::PlacedPlane placed = part_of(wall, away_m * std::cos(turn), away_m * std::sin(turn),
                                      poster.size_m, poster.texture);
    placed.appearance = poster;
    scene.planes.push_back(placed);
  }
}

void add_colourful_room(sim::Scene& scene, base::Random& random, const Palette& palette,
                        double ahead_m, Photographs photographs) {
  const double half_width_m = random.uniform(0.8, 2.5);
  const std::array<double, 5> ranges_m{ahead_m, half_width_m, half_width_m, 1.0, 2.0};
  const std::array<sim::PlacedPlane, 5> walls = room_walls(half_width_m, ahead_m);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    scene.planes.push_back(walls[i]);
    scene.planes.back().appearance.texture = draw_wall(random, palette, ranges_m[i], photographs);
  }
  for (std::size_t i = 0; i < 3 && photographs.empty(); ++i)
    furnish(scene, random, palette, walls[i]);
}

void add_things(sim::Scene& scene, base::Random& random, const Palette& palette,
                const Camera1& camera, const Target& target, bool on_wall, double ahead_m) {
  add_table(scene, random, palette, target, on_wall);
  const double nearest_m = std::max(0.6 * target.range_m, 0.2);
  const double farthest_m =
      on_wall ? 0.85 * target.range_m : std::min(1.5 * target.range_m, 0.95 * ahead_m);
  const int things = 4 + static_cast<int>(6.0 * random.uniform());
  for (int i = 0; i < things; ++i) {
    const double range_m = random.uniform(nearest_m, farthest_m);
    sim::PlacedPlane thing;
    const double size_m = target.radius_rad * range_m * std::exp(random.uniform(0.0, 1.6));
    thing.appearance = draw_thing(random, palette, size_m);
    const double radius_rad = half_diagonal_m(thing.appearance) / range_m;
    const double parallax_rad =
        std::max(camera_moves_m / range_m - camera_moves_m / target.range_m, 0.0);
    const bool behind = range_m > 1.1 * target.range_m;
    const double clear_rad = behind ? 0.0 : 1.1 * (target.radius_rad + radius_rad) + parallax_rad;
    const Eigen::Vector3d direction =
        beside(random, target.direction, clear_rad + 0.3 * random.uniform());
    thing.centre_m = camera.centre_m() + range_m * direction;
    thing.normal = draw_normal(random, camera, 0.5);
    scene.planes.push_back(thing);
  }
}

}  // namespace gazed::benchmarks
