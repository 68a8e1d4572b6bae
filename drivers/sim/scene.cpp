#include "drivers/sim/scene.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "agent/base/strict_toml.hpp"

namespace gazed::sim {

namespace {

constexpr base::Range grey_levels{0.0, 255.0};
constexpr base::Range lengths_m{-100.0, 100.0};
constexpr base::Range ranges_m{0.02, 100.0};
constexpr base::Range directions{-1e3, 1e3};
constexpr std::uintmax_t largest_scene_file = 1U << 20U;
constexpr std::size_t most_planes = 64;
constexpr std::size_t most_tests = 10'000;

template <class T, class Value>
void take(T& member, const std::optional<Value>& value) {
  if (value) member = static_cast<T>(*value);
}

void take(Eigen::Vector3d& member, const std::optional<std::array<double, 3>>& value) {
  if (value) member = Eigen::Vector3d((*value)[0], (*value)[1], (*value)[2]);
}

template <class Enum, std::size_t size>
void take_choice(Enum& member, base::StrictTable& table, std::string_view key,
                 const std::array<std::string_view, size>& names) {
  if (const std::optional<std::size_t> index = table.choice(key, names))
    member = static_cast<Enum>(*index);
}

void read_texture(base::StrictTable table, Texture& texture, const std::string& directory) {
  take_choice(texture.pattern, table, "pattern",
              std::array<std::string_view, 7>{"solid", "checker", "noise", "natural", "leaves",
                                              "collage", "image"});
  take(texture.colour, table.numbers<3>("colour", grey_levels));
  take(texture.colour_2, table.numbers<3>("colour_2", grey_levels));
  take(texture.cell_m, table.number("cell_m", {0.001, 10.0}));
  take(texture.tile_m, table.number("tile_m", {0.01, 100.0}));
  take(texture.contrast, table.number("contrast", {0.0, 128.0}));
  take(texture.seed, table.integer("seed", {0.0, 4294967295.0}));
  take(texture.gradient, table.numbers<2>("gradient", {-1.0, 1.0}));
  take(texture.vignette, table.number("vignette", {0.0, 1.0}));
  if (const std::optional<std::string> file = table.text("file")) {
    try {
      texture.image = load_pnm((std::filesystem::path(directory) / *file).string());
    } catch (const std::invalid_argument& error) {
      table.refuse("file", error.what());
    }
  }
  if (texture.pattern == Pattern::image && !texture.image)
    table.fail("file", "a P5 or P6 picture for pattern \"image\"");
  table.finish();
}

void read_appearance(base::StrictTable& table, Appearance& appearance,
                     const std::string& directory) {
  take_choice(appearance.shape, table, "shape",
              std::array<std::string_view, 2>{"rectangle", "disc"});
  take(appearance.size_m, table.numbers<2>("size_m", {0.001, 200.0}));
  take_choice(appearance.mark, table, "mark",
              std::array<std::string_view, 3>{"none", "ring", "cross"});
  take(appearance.mark_colour, table.numbers<3>("mark_colour", grey_levels));
  if (std::optional<base::StrictTable> texture = table.table("texture"))
    read_texture(*texture, appearance.texture, directory);
}

void read_whole_appearance(std::optional<base::StrictTable> table, Appearance& appearance,
                           const std::string& directory) {
  if (!table) return;
  read_appearance(*table, appearance, directory);
  table->finish();
}

void read_motion(base::StrictTable& table, Motion& motion) {
  take(motion.velocity_m_s, table.numbers<3>("velocity_m_s", {-10.0, 10.0}));
  take(motion.moving_s, table.numbers<2>("moving_s", {0.0, 1e6}));
  if (motion.moving_s[1] < motion.moving_s[0])
    table.fail("moving_s", "[from, to], the second not before the first");
}

void read_planes(base::StrictTable& root, std::string_view key, bool target, Scene& scene,
                 const std::string& directory) {
  for (base::StrictTable& table : root.tables(key)) {
    PlacedPlane plane;
    plane.target = target;
    read_appearance(table, plane.appearance, directory);
    const auto centre_m = table.numbers<3>("centre_m", lengths_m);
    if (!centre_m) table.fail("centre_m", "a position in the torso frame");
    take(plane.centre_m, centre_m);
    take(plane.normal, table.numbers<3>("normal", directions));
    take(plane.up, table.numbers<3>("up", directions));
    if (plane.normal.norm() < 1e-6) table.fail("normal", "a direction, not 0");
    if (plane.up.norm() < 1e-6) table.fail("up", "a direction, not 0");
    read_motion(table, plane.motion);
    table.finish();
    scene.planes.push_back(std::move(plane));
  }
  if (scene.planes.size() > most_planes)
    root.fail(key, "at most " + std::to_string(most_planes) + " planes and targets");
}

void read_report_tests(base::StrictTable& root, const Appearance& object, Scene& scene,
                       const std::string& directory) {
  for (base::StrictTable& table : root.tables("report_test")) {
    SceneTest test;
    test.object = object;
    const std::optional<std::int64_t> number = table.integer("number", {1, 2});
    if (!number) table.fail("number", "1 or 2");
    test.placement = number == 1 ? Placement::image_centre : Placement::image_corner;
    take(test.range_m, table.number("range_m", ranges_m));
    read_motion(table, test.motion);
    read_whole_appearance(table.table("object"), test.object, directory);
    table.finish();
    scene.tests.push_back(std::move(test));
  }
}

void read_target_tests(base::StrictTable& root, const Appearance& object, Scene& scene,
                       const std::string& directory) {
  for (base::StrictTable& table : root.tables("target_test")) {
    SceneTest test;
    test.object = object;
    const auto pixel = table.numbers<2>("pixel", {-10'000.0, 10'000.0});
    const auto position_m = table.numbers<3>("position_m", lengths_m);
    const auto range_m = table.number("range_m", ranges_m);
    const bool has_pixel = table.has("pixel");
    const bool has_position = table.has("position_m");
    if (has_pixel == has_position)
      table.fail(has_pixel ? "position_m" : "pixel", "either pixel and range_m, or position_m");
    else if (has_pixel != table.has("range_m"))
      table.fail("range_m", has_pixel ? "a range to go with pixel" : "none beside position_m");
    test.placement = pixel ? Placement::pixel : Placement::position;
    if (pixel) test.pixel = geometry::Pixel((*pixel)[0], (*pixel)[1]);
    take(test.position_m, position_m);
    take(test.range_m, range_m);
    take(test.wall, table.boolean("wall"));
    take(test.wall_gap_m, table.number("wall_gap_m", {0.0, 100.0}));
    read_motion(table, test.motion);
    read_whole_appearance(table.table("object"), test.object, directory);
    table.finish();
    scene.tests.push_back(std::move(test));
  }
}

void read_robot(std::optional<base::StrictTable> table, RobotTruth& robot) {
  if (!table) return;
  robot.focal_px = table->numbers<2>("focal_px", {10.0, 100'000.0});
  robot.centre_px = table->numbers<2>("centre_px", {-10'000.0, 10'000.0});
  robot.distortion = table->numbers<5>("distortion", {-10.0, 10.0});
  robot.neck_offset_m = table->numbers<3>("neck_offset_m", {-1.0, 1.0});
  robot.mount_offset_m = table->numbers<3>("mount_offset_m", {-1.0, 1.0});
  robot.mount_rotation_rad = table->numbers<3>("mount_rotation_rad", {-3.2, 3.2});
  robot.zero_rad = table->numbers<2>("zero_rad", {-0.5, 0.5});
  table->finish();
}

void read_joints(std::optional<base::StrictTable> table, JointBehaviour& joints) {
  if (!table) return;
  joints.max_speed_rad_s = table->numbers<2>("max_speed_rad_s", {0.1, 100.0});
  take(joints.acceleration_rad_s2, table->number("acceleration_rad_s2", {0.1, 10'000.0}));
  take(joints.settle_time_constant_s, table->number("settle_time_constant_s", {0.0, 1.0}));
  take(joints.settling_error_rad, table->number("settling_error_rad", {0.0, 0.5}));
  take(joints.encoder_step_rad, table->number("encoder_step_rad", {0.0, 0.1}));
  take(joints.encoder_noise_rad, table->number("encoder_noise_rad", {0.0, 0.1}));
  take(joints.encoder_sigma_rad, table->number("encoder_sigma_rad", {0.0, 0.5}));
  take(joints.backlash_rad, table->number("backlash_rad", {0.0, 0.2}));
  take(joints.velocity_noise_rad_s, table->number("velocity_noise_rad_s", {0.0, 1.0}));
  take_choice(joints.velocity, *table, "velocity",
              std::array<std::string_view, 3>{"measured", "none", "zero"});
  table->finish();
}

void read_camera(std::optional<base::StrictTable> table, CameraBehaviour& camera) {
  if (!table) return;
  camera.width_px = table->integer("width_px", {16, 4096});
  camera.height_px = table->integer("height_px", {16, 4096});
  take(camera.fps, table->number("fps", {0.1, 200.0}));
  constexpr std::array<std::string_view, 2> formats{"rgb", "yuyv"};
  if (const std::optional<std::size_t> format = table->choice("format", formats))
    camera.format = *format == 0 ? base::PixelFormat::rgb24 : base::PixelFormat::yuyv;
  if (camera.format == base::PixelFormat::yuyv && camera.width_px && *camera.width_px % 2 != 0)
    table->fail("width_px", "an even width for format \"yuyv\"");
  take(camera.pixel_noise, table->number("pixel_noise", {0.0, 50.0}));
  take(camera.blur_sigma_px, table->number("blur_sigma_px", {0.0, 5.0}));
  take(camera.exposure, table->number("exposure", {0.01, 10.0}));
  take(camera.exposure_swing, table->number("exposure_swing", {0.0, 0.9}));
  take(camera.exposure_period_s, table->number("exposure_period_s", {0.1, 1e6}));
  take(camera.readout_s, table->number("readout_s", {0.0, 0.1}));
  take(camera.delay_s, table->number("delay_s", {-0.2, 0.2}));
  take(camera.drop_rate, table->number("drop_rate", {0.0, 0.9}));
  table->finish();
}

void read_uncertainty(std::optional<base::StrictTable> table,
                      geometry::UncertaintyOverride& uncertainty) {
  if (!table) return;
  constexpr base::Range pixels{0.0, 1000.0}, angles_rad{0.0, 1.0};
  uncertainty.pixel_sigma_px = table->number("pixel_sigma_px", pixels);
  uncertainty.encoder_sigma_rad = table->number("encoder_sigma_rad", angles_rad);
  uncertainty.zero_sigma_rad = table->number("zero_sigma_rad", angles_rad);
  uncertainty.focal_sigma_px = table->number("focal_sigma_px", pixels);
  uncertainty.centre_sigma_px = table->number("centre_sigma_px", pixels);
  uncertainty.mount_offset_sigma_m = table->number("mount_offset_sigma_m", {0.0, 1.0});
  uncertainty.mount_rotation_sigma_rad = table->number("mount_rotation_sigma_rad", angles_rad);
  table->finish();
}

}  // namespace

Scene parse_scene(std::string_view toml_text, const std::string& source_name) {
  base::TomlDocument document(toml_text, source_name, largest_scene_file);
  const std::string directory = std::filesystem::path(source_name).parent_path().string();
  base::StrictTable root(document);
  Scene scene;
  take(scene.repeat, root.boolean("repeat"));
  read_robot(root.table("robot"), scene.robot);
  read_joints(root.table("joints"), scene.joints);
  read_camera(root.table("camera"), scene.camera);
  read_uncertainty(root.table("uncertainty"), scene.uncertainty);
  if (std::optional<base::StrictTable> room = root.table("room")) {
    take(scene.room.background, room->numbers<3>("background", grey_levels));
    room->finish();
  }
  scene.wall.size_m = {4.0, 3.0};
  read_whole_appearance(root.table("wall"), scene.wall, directory);
  Appearance object;
  object.texture.colour = {200, 20, 20};
  read_whole_appearance(root.table("object"), object, directory);
  read_planes(root, "plane", false, scene, directory);
  read_planes(root, "target", true, scene, directory);
  read_report_tests(root, object, scene, directory);
  read_target_tests(root, object, scene, directory);
  root.finish();
  if (scene.tests.size() > most_tests) {
    document.refuse({}, std::to_string(scene.tests.size()) + " tests found; allowed: up to " +
                            std::to_string(most_tests));
  }
  document.check();
  return scene;
}

Scene load_scene(const std::string& path) {
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !file ||
      std::filesystem::file_size(path, error) > largest_scene_file)
    throw std::invalid_argument(path + ": cannot be read; allowed: a scene file (TOML) up to 1 MB");
  return parse_scene(std::string(std::istreambuf_iterator<char>(file), {}), path);
}

}  // namespace gazed::sim
