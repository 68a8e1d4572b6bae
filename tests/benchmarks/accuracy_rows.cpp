#include "tests/benchmarks/accuracy_rows.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/base/random.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/sim/world.hpp"

#include "tests/benchmarks/accuracy_placing.hpp"
#include "tests/benchmarks/colourful_room.hpp"
#include "tests/benchmarks/grey_room.hpp"
#include "tests/benchmarks/hard_things.hpp"
#include "tests/benchmarks/trial_robot.hpp"

namespace gazed::benchmarks {

namespace {

constexpr std::array<double, 1> fine{0.0015}, coarse{0.02}, datasheet{0.001};
constexpr std::array<double, 5> all_sigmas{0.0005, 0.0015, 0.005, 0.01, 0.02};
constexpr std::array<int, 1> two{2}, eight{8};
constexpr std::array<int, 6> all_looks{2, 3, 4, 6, 8, 12};

using enum Room;
using enum Region;
using enum Body;
using enum Strain;

/// Eight looks of a real robot at an object in a colourful room.
constexpr Row real_row(std::string_view name, double range_m, std::uint64_t seeds,
                       Strain strain = none, int width_px = 640) {
  return {.name = name,
          .room = colourful,
          .range_min_m = range_m,
          .range_max_m = range_m,
          .encoder_sigmas_rad = fine,
          .looks = eight,
          .body = real,
          .strain = strain,
          .width_px = width_px,
          .seeds = seeds};
}

constexpr Row with_encoders(Row row, std::span<const double> sigmas_rad) {
  row.encoder_sigmas_rad = sigmas_rad;
  return row;
}

constexpr Row in(Room room, Row row) {
  row.room = room;
  return row;
}

/// Eight looks of a calm robot.
constexpr Row calm_row(std::string_view name, Room room, double range_m, std::uint64_t seeds) {
  Row row = in(room, real_row(name, range_m, seeds));
  row.body = calm;
  return row;
}

/// Two looks by the report's rule.
constexpr Row pair_row(Row row) {
  row.region = frame;
  row.looks = two;
  row.plan = gaze::Plan::report;
  return row;
}

constexpr Row of_the_uncalibrated(Row row) {
  row = with_encoders(row, datasheet);
  row.body = uncalibrated;
  return row;
}

constexpr Row pair_of_the_uncalibrated(Row row) {
  return pair_row(of_the_uncalibrated(row));
}

/// As gazed comes, of a robot that nobody calibrated or of a calibrated one.
constexpr Row default_row(std::string_view name, double range_m, std::uint64_t seeds, Body body,
                          Strain strain = none) {
  Row row = with_encoders(real_row(name, range_m, seeds, strain), datasheet);
  row.region = frame;
  row.looks = {};
  row.body = body;
  return row;
}

constexpr Row up_to(double range_m, Row row) {
  row.range_max_m = range_m;
  return row;
}

constexpr Row above(Row row) {
  row.region = above_level;
  return row;
}

constexpr Row with_looks(Row row, std::span<const int> looks) {
  row.looks = looks;
  return row;
}

constexpr std::array rows{
    real_row("real_03", 0.3, 12),
    real_row("real_10", 1.0, 13),
    real_row("real_20", 2.0, 14),
    with_encoders(real_row("real_joint20_03", 0.3, 15), coarse),
    with_encoders(real_row("real_joint20_10", 1.0, 16), coarse),
    pair_of_the_uncalibrated(real_row("pair_real_03", 0.3, 17)),
    in(photographs, real_row("photos_03", 0.3, 18)),
    in(photographs, real_row("photos_10", 1.0, 19)),
    real_row("sway", 0.3, 20, sway),
    real_row("lens", 0.3, 21, lens),
    real_row("exposure", 0.3, 22, exposure),
    real_row("ball", 0.3, 23, ball),
    real_row("ball_pattern", 0.3, 24, ball_pattern),
    real_row("ball_glossy", 0.3, 25, ball_glossy),
    real_row("highlight", 0.3, 26, highlight),
    real_row("edge", 0.3, 27, edge),
    real_row("jpeg60", 0.3, 28, jpeg),
    real_row("drift", 0.3, 29, drift),
    real_row("jump", 0.3, 30, jump),
    real_row("twins", 0.3, 31, twins),
    real_row("size320_03", 0.3, 32, none, 320),
    real_row("size320_10", 1.0, 33, none, 320),
    real_row("size1280_03", 0.3, 34, none, 1280),
    real_row("size1280_10", 1.0, 35, none, 1280),
    real_row("sweep_03", 0.3, 36, sweep),
    real_row("no_sweep_03", 0.3, 37, no_sweep),
    of_the_uncalibrated(real_row("mount07_03", 0.3, 38)),
    of_the_uncalibrated(real_row("mount07_10", 1.0, 39)),
    of_the_uncalibrated(real_row("real_mount_03", 0.3, 40, real_mount)),
    of_the_uncalibrated(real_row("real_mount_10", 1.0, 41, real_mount)),
    default_row("default_03", 0.3, 47, uncalibrated),
    default_row("default_10", 1.0, 48, uncalibrated),
    default_row("default_mount_03", 0.3, 42, uncalibrated, real_mount),
    default_row("default_mount_10", 1.0, 43, uncalibrated, real_mount),
    default_row("default_calibrated_03", 0.3, 44, real),
    default_row("default_calibrated_10", 1.0, 45, real),
    default_row("default_drift_03", 0.3, 46, real, fast_drift),
    calm_row("textured_03", textured, 0.3, 0),
    calm_row("textured_10", textured, 1.0, 1),
    pair_row(calm_row("pair_03", textured, 0.3, 2)),
    with_encoders(calm_row("joint20_03", textured, 0.3, 3), coarse),
    with_encoders(calm_row("joint20_10", textured, 1.0, 4), coarse),
    calm_row("blank_03", blank, 0.3, 5),
    calm_row("blank_10", blank, 1.0, 6),
    above(up_to(1.0, calm_row("above", textured, 0.3, 7))),
    calm_row("textured_20", textured, 2.0, 8),
    up_to(2.0, calm_row("cluttered", cluttered, 0.2, 9)),
    with_looks(calm_row("looks_03", textured, 0.3, 10), all_looks),
    with_encoders(calm_row("joints_10", textured, 1.0, 11), all_sigmas),
};

// Streams of the seed.
enum WorldStream : std::uint64_t {
  target_stream = 202,
  room_stream,
  clutter_stream,
  things_stream = 206,
  hard_stream = 208,
};

constexpr std::uint64_t trials_a_row = 1'000'000;

/// Read once, the pictures that this machine made of its photographs.
Photographs photographs_of_the_machine() {
  static const std::vector<std::shared_ptr<const sim::MipMap>> all = [] {
    const char* folder = std::getenv("GAZED_PHOTOGRAPHS");
    std::vector<std::filesystem::path> files;
    if (folder != nullptr)
      for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".ppm") files.push_back(entry.path());
    if (files.empty())
      throw std::runtime_error("GAZED_PHOTOGRAPHS: no folder with P6 files (*.ppm)");
    std::sort(files.begin(), files.end());
    std::vector<std::shared_ptr<const sim::MipMap>> pictures;
    for (const auto& file : files) pictures.push_back(sim::load_pnm(file.string()));
    return pictures;
  }();
  return all;
}

/// Grey or blank, as the literature likes it.
void draw_calm_room(sim::Scene& scene, const Row& row, base::Random& room, const Target& target,
                    bool on_wall, const Camera1& camera, std::uint64_t seed) {
  if (on_wall) {
    const double size_m = 3.0 + 3.0 * target.range_m;
    scene.planes.push_back(plane(target.object.centre_m, target.object.normal, {size_m, size_m},
                                 photographic(room, target.range_m)));
  }
  if (row.room == blank) {
    sim::Texture& wall = scene.planes.back().appearance.texture;
    wall = sim::Texture{};
    wall.colour = {226, 224, 219};
    const double across = room.uniform(-0.25, 0.25);
    wall.gradient = {across, room.uniform(-0.25, 0.25)};
  } else if (!on_wall) {
    const double ahead_m = target.range_m + room.uniform(0.5, 2.5);
    add_room(scene, room, ahead_m);
    if (row.room == cluttered) {
      base::Random clutter(seed, clutter_stream);
      add_clutter(scene, clutter, camera, target.direction, target.radius_rad, ahead_m);
    }
  }
}

void draw_world(Trial& trial, const Row& row, const Camera1& camera) {
  base::Random random(trial.seed, target_stream), room(trial.seed, room_stream);
  const bool is_colourful = row.room == colourful || row.room == photographs;
  Palette palette;
  Target target;
  if (is_colourful) palette.hue = room.uniform();
  target.range_m = row.range_min_m * std::pow(row.range_max_m / row.range_min_m, random.uniform());
  target.object.target = true;
  target.object.appearance = is_colourful ? draw_colourful_object(random, palette, target.range_m)
                                          : draw_red_object(random, target.range_m);
  target.radius_rad = 0.5 * target.object.appearance.size_m[0] / target.range_m;
  target.direction = draw_direction(random, row.region, camera, target.radius_rad, target.range_m);
  target.object.centre_m = camera.centre_m() + target.range_m * target.direction;
  const bool on_wall = row.room == blank ||
                       (row.room != cluttered && !is_ball(row.strain) && random.uniform() < 0.5);
  target.object.normal = draw_normal(random, camera, on_wall ? 0.1 : 0.3);
  trial.range_m = target.range_m;
  trial.elevation_rad = std::asin(target.direction.z());
  trial.layout = on_wall ? "wall" : "free";
  if (is_colourful) {
    const Photographs papers =
        row.room == photographs ? photographs_of_the_machine() : Photographs{};
    const double ahead_m = target.range_m + (on_wall ? 0.0 : room.uniform(0.3, 2.5));
    if (on_wall)
      add_wall_behind(trial.scene, room, palette, target, papers);
    else
      add_colourful_room(trial.scene, room, palette, ahead_m, papers);
    base::Random things(trial.seed, things_stream);
    add_things(trial.scene, things, palette, camera, target, on_wall, ahead_m);
  } else {
    draw_calm_room(trial.scene, row, room, target, on_wall, camera, trial.seed);
  }
  base::Random hard(trial.seed, hard_stream);
  add_hard_things(trial.scene, hard, row.strain, camera, target);
  trial.scene.planes.push_back(target.object);
}

}  // namespace

std::span<const Row> accuracy_rows() {
  return rows;
}

Trial draw_trial(const Row& row, std::uint64_t index) {
  Trial trial;
  trial.seed = index + trials_a_row * row.seeds;
  trial.settings = settings::default_settings("nao-v6");
  trial.settings.cycle.locate.plan = row.plan;
  draw_robot(trial, row);
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  draw_world(trial, row, Camera1(sim::true_robot(trial.scene, profile)));
  return trial;
}

}  // namespace gazed::benchmarks
