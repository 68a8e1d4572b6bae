#include "tests/benchmarks/accuracy_rows.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

#include "agent/base/random.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/sim/world.hpp"

namespace gazed::benchmarks {

namespace {

constexpr std::array<double, 1> fine{0.0015}, coarse{0.02};
constexpr std::array<double, 5> all_sigmas{0.0005, 0.0015, 0.005, 0.01, 0.02};
constexpr std::array<int, 1> two{2}, eight{8};
constexpr std::array<int, 6> all_looks{2, 3, 4, 6, 8, 12};

using enum Room;
using enum Region;
constexpr std::array<Row, 12> rows{{
    {"textured_03", textured, level_or_below, 0.3, 0.3, fine, eight, gaze::Plan::parallax},
    {"textured_10", textured, level_or_below, 1.0, 1.0, fine, eight, gaze::Plan::parallax},
    {"pair_03", textured, frame, 0.3, 0.3, fine, two, gaze::Plan::report},
    {"joint20_03", textured, level_or_below, 0.3, 0.3, coarse, eight, gaze::Plan::parallax},
    {"joint20_10", textured, level_or_below, 1.0, 1.0, coarse, eight, gaze::Plan::parallax},
    {"blank_03", blank, level_or_below, 0.3, 0.3, fine, eight, gaze::Plan::parallax},
    {"blank_10", blank, level_or_below, 1.0, 1.0, fine, eight, gaze::Plan::parallax},
    {"above", textured, above_level, 0.3, 1.0, fine, eight, gaze::Plan::parallax},
    {"textured_20", textured, level_or_below, 2.0, 2.0, fine, eight, gaze::Plan::parallax},
    {"cluttered", cluttered, level_or_below, 0.2, 2.0, fine, eight, gaze::Plan::parallax},
    {"looks_03", textured, level_or_below, 0.3, 0.3, fine, all_looks, gaze::Plan::parallax},
    {"joints_10", textured, level_or_below, 1.0, 1.0, all_sigmas, eight, gaze::Plan::parallax},
}};

// Streams of the seed.
enum Stream : std::uint64_t { robot_stream = 201, target_stream, room_stream, clutter_stream };

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

// Rows share no seeds, so that their figures are independent.
constexpr std::uint64_t trials_a_row = 1'000'000;

// The standing robot's torso above the floor: hip offset, thigh, tibia, foot (NAO
// documentation 2.1, "Links": 85 + 100 + 102.9 + 45.19 mm).
constexpr double floor_z_m = -0.333;
constexpr double ceiling_z_m = 2.2;

// Near things are the report's printed disc, far ones the ball of RoboCup's standard platform
// league (100 mm).
constexpr double small_object_m = 0.06, large_object_m = 0.10, large_from_m = 0.5;

// A papered wall's tile is 730 px wide, so that it does not repeat inside a frame (a pixel is range
// / 608).
constexpr double tile_by_range = 1.2;

double between(base::Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

template <class T>
T one_of(base::Random& random, std::span<const T> values) {
  return values[static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()))];
}

sim::Texture photographic(base::Random& random, double range_m) {
  sim::Texture texture;
  texture.pattern = sim::Pattern::leaves;
  const double grey = between(random, 90.0, 150.0);
  texture.colour = {grey * between(random, 0.95, 1.05), grey, grey * between(random, 0.95, 1.05)};
  texture.contrast = between(random, 15.0, 30.0);
  texture.tile_m = tile_by_range * range_m;
  texture.seed = 1 + static_cast<std::uint32_t>(random.uniform() * 1e6);
  return texture;
}

sim::PlacedPlane plane(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& normal,
                       std::array<double, 2> size_m, const sim::Texture& texture) {
  sim::PlacedPlane placed;
  placed.centre_m = centre_m;
  placed.normal = normal;
  placed.appearance.size_m = size_m;
  placed.appearance.texture = texture;
  return placed;
}

void draw_robot(Trial& trial, const geometry::RobotProfile& profile, base::Random& random) {
  const auto error = [&random](double sigma) { return sigma * random.normal(); };
  sim::RobotTruth& robot = trial.scene.robot;
  const double focal_error_px = error(*calibrated.focal_sigma_px);  // of fx and fy together
  robot.focal_px = {profile.camera.focal_px.x() + focal_error_px,
                    profile.camera.focal_px.y() + focal_error_px};
  const auto off = [&](const Eigen::Vector3d& nominal, double sigma) {
    const double x = nominal.x() + error(sigma), y = nominal.y() + error(sigma);
    return std::array<double, 3>{x, y, nominal.z() + error(sigma)};
  };
  const double centre_x_px = profile.camera.centre_px.x() + error(*calibrated.centre_sigma_px);
  robot.centre_px = {centre_x_px,
                     profile.camera.centre_px.y() + error(*calibrated.centre_sigma_px)};
  robot.mount_offset_m = off(profile.head.mount_offset_m, *calibrated.mount_offset_sigma_m);
  robot.mount_rotation_rad =
      off(profile.head.mount_rotation_rad, *calibrated.mount_rotation_sigma_rad);
  const double zero_yaw_rad = error(*calibrated.zero_sigma_rad);
  robot.zero_rad = {zero_yaw_rad, error(*calibrated.zero_sigma_rad)};
}

/// The true camera 1: where it is, and the ray through a pixel, torso frame.
struct Camera1 {
  sim::TrueRobot robot;
  geometry::Pose torso_from_cam;

  explicit Camera1(const sim::TrueRobot& truth)
      : robot(truth),
        torso_from_cam(geometry::cam_from_torso(truth.head, geometry::HeadAngles{}).inverse()) {}

  [[nodiscard]] const Eigen::Vector3d& centre_m() const { return torso_from_cam.translation; }
  [[nodiscard]] Eigen::Vector3d axis() const { return torso_from_cam.rotation.col(2); }
  [[nodiscard]] Eigen::Vector3d direction(const geometry::Pixel& pixel) const {
    return torso_from_cam.rotation *
           geometry::normalise(robot.camera, pixel)->homogeneous().normalized();
  }
};

bool inside(Region region, double elevation_rad) {
  switch (region) {
    case frame:
      return true;
    case level_or_below:
      return elevation_rad <= 0.0;
    case above_level:
      break;
  }
  return elevation_rad > 0.0 && elevation_rad <= 0.3;
}

/// A direction in which a thing of this radius is seen whole, a saliency cell off the border, and
/// stands above the floor.
Eigen::Vector3d draw_direction(base::Random& random, Region region, const Camera1& camera,
                               double radius_rad, double range_m) {
  const geometry::CameraModel& model = camera.robot.camera;
  const double border_px = 16.0 + 1.2 * model.focal_px.x() * radius_rad;
  while (true) {
    const double x = between(random, border_px, model.width_px - 1 - border_px);
    const double y = between(random, border_px, model.height_px - 1 - border_px);
    const Eigen::Vector3d direction = camera.direction(geometry::Pixel(x, y));
    const double bottom_z_m = camera.centre_m().z() + range_m * (direction.z() - radius_rad);
    if (inside(region, std::asin(direction.z())) && bottom_z_m > floor_z_m) return direction;
  }
}

/// Towards the camera against its optical axis, turned by up to `tilt_rad` about two axes.
Eigen::Vector3d draw_normal(base::Random& random, const Camera1& camera, double tilt_rad) {
  const Eigen::AngleAxisd yaw(tilt_rad * random.symmetric(), Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(tilt_rad * random.symmetric(), Eigen::Vector3d::UnitY());
  return yaw * (pitch * -camera.axis());
}

sim::Appearance draw_object(base::Random& random, double range_m) {
  sim::Appearance object;
  object.shape = random.uniform() < 0.5 ? sim::Shape::disc : sim::Shape::rectangle;
  const double size_m = range_m < large_from_m ? small_object_m : large_object_m;
  object.size_m = {size_m, size_m};
  object.texture.pattern = sim::Pattern::natural;  // print that is not quite even
  object.texture.colour = {between(random, 180, 210), between(random, 15, 40),
                           between(random, 15, 40)};
  object.texture.contrast = 3.0;
  object.texture.tile_m = 0.1;
  constexpr std::array<sim::Mark, 3> marks{sim::Mark::none, sim::Mark::ring, sim::Mark::cross};
  object.mark = one_of(random, std::span<const sim::Mark>(marks));
  object.mark_colour = {128, 10, 16};
  return object;
}

/// Floor, ceiling, walls to both sides and ahead.
void add_room(sim::Scene& scene, base::Random& random, double ahead_m) {
  const double half_width_m = between(random, 1.2, 2.5);
  const double middle_m = 0.5 * ahead_m, middle_z_m = 0.5 * (floor_z_m + ceiling_z_m);
  const std::array<double, 2> side{2.0 * ahead_m + 6.0, ceiling_z_m - floor_z_m};
  const std::array<double, 2> flat{2.0 * half_width_m, 2.0 * ahead_m + 6.0};
  const auto add = [&](const Eigen::Vector3d& centre_m, const Eigen::Vector3d& normal,
                       std::array<double, 2> size_m, double range_m) {
    scene.planes.push_back(plane(centre_m, normal, size_m, photographic(random, range_m)));
  };
  add({ahead_m, 0.0, middle_z_m}, -Eigen::Vector3d::UnitX(), {2.0 * half_width_m, side[1]},
      ahead_m);
  add({middle_m, half_width_m, middle_z_m}, -Eigen::Vector3d::UnitY(), side, half_width_m);
  add({middle_m, -half_width_m, middle_z_m}, Eigen::Vector3d::UnitY(), side, half_width_m);
  add({middle_m, 0.0, floor_z_m}, Eigen::Vector3d::UnitZ(), flat, 1.0);
  add({middle_m, 0.0, ceiling_z_m}, -Eigen::Vector3d::UnitZ(), flat, 2.0);
}

void add_clutter(sim::Scene& scene, base::Random& random, const Camera1& camera,
                 const Eigen::Vector3d& target_direction, double target_radius_rad,
                 double ahead_m) {
  constexpr int dull_things = 6;
  for (int i = 0; i <= dull_things; ++i) {
    const bool stands_out = i == dull_things;
    const double range_m = between(random, 0.4, 0.9 * ahead_m);
    const double radius_rad = between(random, 0.04, 0.10);
    Eigen::Vector3d direction;
    do {
      direction = draw_direction(random, frame, camera, radius_rad, range_m);
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
      thing.appearance.texture.colour = {between(random, 80, 160), between(random, 80, 160),
                                         between(random, 80, 160)};
    }
    scene.planes.push_back(thing);
  }
}

void draw_world(Trial& trial, const Row& row, const Camera1& camera) {
  base::Random random(trial.seed, target_stream), room(trial.seed, room_stream);
  trial.range_m = row.range_min_m * std::pow(row.range_max_m / row.range_min_m, random.uniform());
  sim::PlacedPlane object;
  object.target = true;
  object.appearance = draw_object(random, trial.range_m);
  const double radius_rad = 0.5 * object.appearance.size_m[0] / trial.range_m;
  const Eigen::Vector3d direction =
      draw_direction(random, row.region, camera, radius_rad, trial.range_m);
  trial.elevation_rad = std::asin(direction.z());
  object.centre_m = camera.centre_m() + trial.range_m * direction;

  const bool on_wall = row.room == blank || (row.room == textured && random.uniform() < 0.5);
  trial.layout = on_wall ? "wall" : "free";
  object.normal = draw_normal(random, camera, on_wall ? 0.1 : 0.3);
  sim::Scene& scene = trial.scene;
  if (on_wall) {
    const double size_m = 3.0 + 3.0 * trial.range_m;
    scene.planes.push_back(
        plane(object.centre_m, object.normal, {size_m, size_m}, photographic(room, trial.range_m)));
  }
  if (row.room == blank) {
    sim::Texture& wall = scene.planes.back().appearance.texture;
    wall = sim::Texture{};
    wall.colour = {226, 224, 219};
    wall.gradient = {between(room, -0.25, 0.25), between(room, -0.25, 0.25)};
  } else if (!on_wall) {
    const double ahead_m = trial.range_m + between(room, 0.5, 2.5);
    add_room(scene, room, ahead_m);
    if (row.room == cluttered) {
      base::Random clutter(trial.seed, clutter_stream);
      add_clutter(scene, clutter, camera, direction, radius_rad, ahead_m);
    }
  }
  scene.planes.push_back(object);
}

}  // namespace

std::span<const Row> accuracy_rows() {
  return rows;
}

Trial draw_trial(const Row& row, std::uint64_t index) {
  Trial trial;
  trial.seed = index + trials_a_row * static_cast<std::uint64_t>(&row - rows.data());
  trial.settings = settings::default_settings("nao-v6");
  const geometry::RobotProfile profile = *geometry::robot_profile("nao-v6");
  base::Random random(trial.seed, robot_stream);
  draw_robot(trial, profile, random);
  const double encoder_sigma_rad = one_of(random, row.encoder_sigmas_rad);
  trial.settings.locate.looks = one_of(random, row.looks);
  trial.settings.locate.plan = row.plan;
  trial.scene.joints.encoder_sigma_rad = encoder_sigma_rad;
  trial.scene.joints.settling_error_rad = settling_error_rad;
  trial.scene.camera.pixel_noise = 2.0;
  trial.scene.camera.blur_sigma_px = 0.5;
  geometry::Uncertainty& told = trial.settings.uncertainty;
  told.encoder_sigma_rad = encoder_sigma_rad;
  told.zero_sigma_rad = *calibrated.zero_sigma_rad;
  told.focal_sigma_px = *calibrated.focal_sigma_px;
  told.centre_sigma_px = *calibrated.centre_sigma_px;
  told.mount_offset_sigma_m = *calibrated.mount_offset_sigma_m;
  told.mount_rotation_sigma_rad = *calibrated.mount_rotation_sigma_rad;
  draw_world(trial, row, Camera1(sim::true_robot(trial.scene, profile)));
  return trial;
}

}  // namespace gazed::benchmarks
