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

namespace gazed::benchmarks {

namespace {

constexpr std::array<double, 1> fine{0.0015}, coarse{0.02}, datasheet{0.001};
constexpr std::array<double, 5> all_sigmas{0.0005, 0.0015, 0.005, 0.01, 0.02};
constexpr std::array<int, 1> two{2}, eight{8};
constexpr std::array<int, 6> all_looks{2, 3, 4, 6, 8, 12};

using enum Room;
using enum Region;
using enum Body;
using enum gaze::Plan;
constexpr std::array rows{
    Row{"real_03", colourful, level_or_below, 0.3, 0.3, fine, eight, parallax, real, Strain::none,
        12},
    Row{"real_10", colourful, level_or_below, 1.0, 1.0, fine, eight, parallax, real, Strain::none,
        13},
    Row{"real_20", colourful, level_or_below, 2.0, 2.0, fine, eight, parallax, real, Strain::none,
        14},
    Row{"real_joint20_03", colourful, level_or_below, 0.3, 0.3, coarse, eight, parallax, real,
        Strain::none, 15},
    Row{"real_joint20_10", colourful, level_or_below, 1.0, 1.0, coarse, eight, parallax, real,
        Strain::none, 16},
    Row{"pair_real_03", colourful, frame, 0.3, 0.3, datasheet, two, report, uncalibrated,
        Strain::none, 17},
    Row{"photos_03", photographs, level_or_below, 0.3, 0.3, fine, eight, parallax, real,
        Strain::none, 18},
    Row{"photos_10", photographs, level_or_below, 1.0, 1.0, fine, eight, parallax, real,
        Strain::none, 19},
    Row{"sway", colourful, level_or_below, 0.3, 0.3, fine, eight, parallax, real, Strain::sway, 20},
    Row{"lens", colourful, level_or_below, 0.3, 0.3, fine, eight, parallax, real, Strain::lens, 21},
    Row{"exposure", colourful, level_or_below, 0.3, 0.3, fine, eight, parallax, real,
        Strain::exposure, 22},
    Row{"textured_03", textured, level_or_below, 0.3, 0.3, fine, eight, parallax, calm,
        Strain::none, 0},
    Row{"textured_10", textured, level_or_below, 1.0, 1.0, fine, eight, parallax, calm,
        Strain::none, 1},
    Row{"pair_03", textured, frame, 0.3, 0.3, fine, two, report, calm, Strain::none, 2},
    Row{"joint20_03", textured, level_or_below, 0.3, 0.3, coarse, eight, parallax, calm,
        Strain::none, 3},
    Row{"joint20_10", textured, level_or_below, 1.0, 1.0, coarse, eight, parallax, calm,
        Strain::none, 4},
    Row{"blank_03", blank, level_or_below, 0.3, 0.3, fine, eight, parallax, calm, Strain::none, 5},
    Row{"blank_10", blank, level_or_below, 1.0, 1.0, fine, eight, parallax, calm, Strain::none, 6},
    Row{"above", textured, above_level, 0.3, 1.0, fine, eight, parallax, calm, Strain::none, 7},
    Row{"textured_20", textured, level_or_below, 2.0, 2.0, fine, eight, parallax, calm,
        Strain::none, 8},
    Row{"cluttered", cluttered, level_or_below, 0.2, 2.0, fine, eight, parallax, calm, Strain::none,
        9},
    Row{"looks_03", textured, level_or_below, 0.3, 0.3, fine, all_looks, parallax, calm,
        Strain::none, 10},
    Row{"joints_10", textured, level_or_below, 1.0, 1.0, all_sigmas, eight, parallax, calm,
        Strain::none, 11},
};

// Streams of the seed.
enum Stream : std::uint64_t {
  robot_stream = 201,
  target_stream,
  room_stream,
  clutter_stream,
  body_stream,
  things_stream,
  strain_stream,
};

// A calibrated robot, as the default scene's (drivers/sim/default_scene.cpp).
constexpr geometry::UncertaintyOverride calibrated{.encoder_sigma_rad = {},
                                                   .zero_sigma_rad = 0.003,
                                                   .focal_sigma_px = 0.5,
                                                   .centre_sigma_px = 1.0,
                                                   .mount_offset_sigma_m = 0.001,
                                                   .mount_rotation_sigma_rad = 0.003};

// Joints miss their commands by up to this much (Russcher 2011, chapter 5): an error of the motion,
// not of what is measured.
constexpr double settling_error_rad = 0.02;

constexpr std::uint64_t trials_a_row = 1'000'000;

/// What the agent is told of a robot's errors; each is drawn with its sigma.
geometry::Uncertainty told_of(Body body, const geometry::RobotProfile& profile,
                              double encoder_sigma_rad) {
  geometry::Uncertainty told = profile.rig.uncertainty;
  told.encoder_sigma_rad = encoder_sigma_rad;
  if (body == uncalibrated) return told;
  told.zero_sigma_rad = *calibrated.zero_sigma_rad;
  told.focal_sigma_px = *calibrated.focal_sigma_px;
  told.centre_sigma_px = *calibrated.centre_sigma_px;
  told.mount_offset_sigma_m = *calibrated.mount_offset_sigma_m;
  told.mount_rotation_sigma_rad = *calibrated.mount_rotation_sigma_rad;
  return told;
}

void draw_robot(sim::RobotTruth& robot, const geometry::Rig& rig, const geometry::Uncertainty& told,
                base::Random& random) {
  const auto error = [&random](double sigma) { return sigma * random.normal(); };
  const double focal_error_px = error(told.focal_sigma_px);  // of fx and fy together
  robot.focal_px = {rig.camera.focal_px.x() + focal_error_px,
                    rig.camera.focal_px.y() + focal_error_px};
  const auto off = [&](const Eigen::Vector3d& nominal, double sigma) {
    const double x = nominal.x() + error(sigma), y = nominal.y() + error(sigma);
    return std::array<double, 3>{x, y, nominal.z() + error(sigma)};
  };
  const double centre_x_px = rig.camera.centre_px.x() + error(told.centre_sigma_px);
  robot.centre_px = {centre_x_px, rig.camera.centre_px.y() + error(told.centre_sigma_px)};
  robot.mount_offset_m = off(rig.head.mount_offset_m, told.mount_offset_sigma_m);
  robot.mount_rotation_rad = off(rig.head.mount_rotation_rad, told.mount_rotation_sigma_rad);
  const double zero_yaw_rad = error(told.zero_sigma_rad);
  robot.zero_rad = {zero_yaw_rad, error(told.zero_sigma_rad)};
}

/// How joints and camera behave.
void draw_body(Trial& trial, Body body, const geometry::RobotProfile& profile) {
  sim::JointBehaviour& joints = trial.scene.joints;
  sim::CameraBehaviour& camera = trial.scene.camera;
  joints.encoder_sigma_rad = trial.settings.rig.uncertainty.encoder_sigma_rad;
  joints.settling_error_rad = settling_error_rad;
  camera.pixel_noise = 2.0;
  camera.blur_sigma_px = 0.5;
  if (body == calm) return;
  base::Random random(trial.seed, body_stream);
  joints.settle_time_constant_s = 0.08;
  joints.encoder_step_rad = 0.00153;  // 12 bits
  joints.encoder_noise_rad = 0.0002;  // flickers where two steps meet
  joints.velocity = sim::Velocity::none;
  camera.format = base::PixelFormat::yuyv;
  camera.pixel_noise = random.uniform(1.5, 3.0);
  camera.blur_sigma_px = random.uniform(0.5, 0.8);
  camera.readout_s = profile.readout_s;
  camera.delay_s = 0.002 * random.normal();  // what is left of the delay that drivers add
  trial.settings.cycle.camera.readout_s = profile.readout_s;
}

/// What the trial's robot and camera suffer beside.
void add_strain(Trial& trial, Strain strain) {
  base::Random random(trial.seed, strain_stream);
  sim::Scene& scene = trial.scene;
  switch (strain) {
    case Strain::none:
      break;
    case Strain::sway:
      scene.sway = {.translation_m = 0.002, .rotation_rad = 0.005, .frequency_hz = 0.3};
      break;
    case Strain::lens: {
      // Half a field of view is 0.66 focal lengths long: 608 x 0.66^3 x 0.012 px in the corners.
      const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
      const double k1 = sign * random.uniform(0.008, 0.016), k2 = 0.004 * random.normal();
      scene.robot.distortion = {k1, k2, 0.0, 0.0, 0.0};
      break;
    }
    case Strain::exposure:
      scene.camera.exposure_step = 0.3;
      break;
  }
}

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
  const bool on_wall = row.room == blank || (row.room != cluttered && random.uniform() < 0.5);
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
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  geometry::Uncertainty& told = trial.settings.rig.uncertainty;
  told = told_of(row.body, profile, 0.0);
  base::Random random(trial.seed, robot_stream);
  draw_robot(trial.scene.robot, profile.rig, told, random);
  told.encoder_sigma_rad = one_of(random, row.encoder_sigmas_rad);
  trial.settings.cycle.locate.looks = one_of(random, row.looks);
  trial.settings.cycle.locate.plan = row.plan;
  draw_body(trial, row.body, profile);
  add_strain(trial, row.strain);
  draw_world(trial, row, Camera1(sim::true_robot(trial.scene, profile)));
  return trial;
}

}  // namespace gazed::benchmarks
