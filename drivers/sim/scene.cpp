#include "drivers/sim/scene.hpp"

#include <cstddef>
#include <filesystem>

#include "agent/base/regular_file.hpp"
#include "agent/base/strict_toml.hpp"
#include "drivers/sim/scene_reading.hpp"

namespace gazed::sim {

namespace {

constexpr std::size_t largest_scene_file = 1U << 20U;
constexpr std::size_t most_tests = 10'000;

}  // namespace

Scene parse_scene(std::string_view toml_text, const std::string& source_name) {
  using namespace reading;
  base::TomlDocument document(toml_text, source_name, largest_scene_file);
  const std::string directory = std::filesystem::path(source_name).parent_path().string();
  base::StrictTable root(document);
  Scene scene;
  take(scene.repeat, root.boolean("repeat"));
  read_robot(root.table("robot"), scene.robot);
  read_joints(root.table("joints"), scene.joints);
  read_sway(root.table("sway"), scene.sway);
  read_camera(root.table("camera"), scene.camera);
  read_uncertainty(root.table("uncertainty"), scene.uncertainty);
  if (std::optional<base::StrictTable> room = root.table("room")) {
    take(scene.room.background, room->numbers<3>("background", grey_levels));
    take(scene.room.lamp_m, room->numbers<3>("lamp_m", {-100.0, 100.0}));
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
  return parse_scene(base::read_text(path, largest_scene_file), path);
}

}  // namespace gazed::sim
