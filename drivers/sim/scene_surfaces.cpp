#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "drivers/sim/scene_reading.hpp"

namespace gazed::sim::reading {

namespace {

constexpr base::Range lengths_m{-100.0, 100.0};
constexpr base::Range ranges_m{0.02, 100.0};
constexpr base::Range directions{-1e3, 1e3};
constexpr std::size_t most_planes = 64;

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
              std::array<std::string_view, 4>{"rectangle", "disc", "ball", "box"});
  take(appearance.size_m, table.numbers<2>("size_m", {0.001, 200.0}));
  take(appearance.depth_m, table.number("depth_m", {0.001, 200.0}));
  take(appearance.finish.shading, table.number("shading", {0.0, 1.0}));
  take(appearance.finish.gloss, table.number("gloss", {0.0, 1.0}));
  take(appearance.finish.shininess, table.integer("shininess", {1, 4096}));
  if (appearance.shape == Shape::ball && appearance.size_m[0] != appearance.size_m[1])
    table.fail("size_m", "the same twice for shape \"ball\"");
  take_choice(appearance.mark, table, "mark",
              std::array<std::string_view, 3>{"none", "ring", "cross"});
  if (appearance.shape == Shape::ball && appearance.mark != Mark::none)
    table.fail("mark", "\"none\" for shape \"ball\"");
  take(appearance.mark_colour, table.numbers<3>("mark_colour", grey_levels));
  if (std::optional<base::StrictTable> texture = table.table("texture"))
    read_texture(*texture, appearance.texture, directory);
}

void read_motion(base::StrictTable& table, Motion& motion) {
  take(motion.velocity_m_s, table.numbers<3>("velocity_m_s", {-10.0, 10.0}));
  take(motion.moving_s, table.numbers<2>("moving_s", {0.0, 1e6}));
  if (motion.moving_s[1] < motion.moving_s[0])
    table.fail("moving_s", "[from, to], the second not before the first");
}

}  // namespace

void read_whole_appearance(std::optional<base::StrictTable> table, Appearance& appearance,
                           const std::string& directory) {
  if (!table) return;
  read_appearance(*table, appearance, directory);
  table->finish();
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

}  // namespace gazed::sim::reading
