#include "agent/settings/settings.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/settings/table.hpp"
#include "agent/settings/toml.hpp"

namespace gazed::settings {
namespace {

using Layer = std::vector<Entry>;

Layer layer_of(const std::vector<Assignment>& assignments) {
  Layer layer;
  for (const Assignment& assignment : assignments) layer.push_back(entry_of(assignment));
  return layer;
}

Value stated_value(double number) {
  return number;
}
Value stated_value(const std::array<double, 2>& numbers) {
  return std::vector<double>(numbers.begin(), numbers.end());
}

Layer layer_of(const geometry::UncertaintyOverride& stated, const std::string& scene) {
  Layer layer;
  const auto add = [&](std::string_view path, const auto& sigma) {
    if (!sigma) return;
    Value value = stated_value(*sigma);
    std::string text = toml_text(value);
    layer.push_back({find_key(path), std::move(value), std::move(text), scene});
  };
  add("uncertainty.pixel_sigma_px", stated.pixel_sigma_px);
  add("uncertainty.encoder_sigma_rad", stated.encoder_sigma_rad);
  add("uncertainty.zero_sigma_rad", stated.zero_sigma_rad);
  add("uncertainty.focal_sigma_px", stated.focal_sigma_px);
  add("uncertainty.centre_sigma_px", stated.centre_sigma_px);
  add("uncertainty.distortion_sigma", stated.distortion_sigma);
  add("uncertainty.mount_offset_sigma_m", stated.mount_offset_sigma_m);
  add("uncertainty.mount_rotation_sigma_rad", stated.mount_rotation_sigma_rad);
  add("uncertainty.torso_rotation_sigma_rad", stated.torso_rotation_sigma_rad);
  add("uncertainty.torso_translation_sigma_m", stated.torso_translation_sigma_m);
  add("uncertainty.corner_slip", stated.corner_slip);
  return layer;
}

/// What decides where things are and how sure that is, and the prefix of the log's channels; what
/// the log's own run read, wrote and printed is not repeated.
Layer recorded_layer(const std::string& toml, const std::string& log_file) {
  return read_toml(toml, "configuration in " + log_file, [](std::string_view path) {
    const auto in = [path](std::string_view table) { return path.starts_with(table); };
    return !path.ends_with(".source") &&
           (path == "robot" || path == "lcm.prefix" || in("camera.") || in("head.") ||
            in("uncertainty.") || in("saliency.") || in("gaze.") || in("locate."));
  });
}

/// Layers, the first the weakest, with the questions that more than one of them answers. They
/// outlive it.
class Layers {
 public:
  void add(const Layer& layer) { layers_.push_back(&layer); }

  void apply(Settings& settings) const {
    for (const Layer* layer : layers_) {
      for (const Entry& entry : *layer) assign(settings, entry);
    }
  }

  /// What set `path` last; null when nothing did.
  [[nodiscard]] const Entry* last(std::string_view path) const {
    const Entry* result = nullptr;
    for (const Layer* layer : layers_) {
      for (const Entry& entry : *layer) {
        if (entry.key->path == path) result = &entry;
      }
    }
    return result;
  }

  [[nodiscard]] bool has(std::string_view path) const { return last(path) != nullptr; }

 private:
  std::vector<const Layer*> layers_;
};

[[noreturn]] void refuse(const Layers& layers, std::string_view path, const std::string& found,
                         std::string_view allowed) {
  const Entry* entry = layers.last(path);
  throw SettingsError((entry != nullptr ? entry->where + ": " : "") + std::string(path) + ": " +
                      found + " found; allowed: " + std::string(allowed) +
                      (entry != nullptr ? entry->excerpt : ""));
}

[[noreturn]] void refuse(const Layers& layers, std::string_view path, const Settings& settings,
                         std::string_view allowed) {
  refuse(layers, path, base::excerpt(toml_text(read(settings, *find_key(path)))), allowed);
}

/// The profile's intrinsics are those of its own image size. The driver scales the whole image, so
/// at another size of the same aspect they scale with it; a half pixel moves with its pixel's
/// centre.
void scale_intrinsics(Settings& settings, int width_px, int height_px) {
  geometry::CameraModel& model = settings.rig.camera;
  if (width_px == model.width_px && height_px == model.height_px) return;
  const double scale = static_cast<double>(width_px) / model.width_px;
  model.width_px = width_px;
  model.height_px = height_px;
  model.focal_px *= scale;
  model.centre_px = (model.centre_px.array() + 0.5) * scale - 0.5;
  settings.rig.uncertainty.focal_sigma_px *= scale;
  settings.rig.uncertainty.centre_sigma_px *= scale;
}

/// What a NAO's camera needs to be what its profile says.
v4l2::CameraControls profile_controls(const geometry::VideoProfile& video) {
  v4l2::CameraControls controls;
  controls.flip_horizontal = controls.flip_vertical = video.upside_down;
  if (video.has_auto_focus) {
    // A lens that moves changes the focal length. It stays where B-Human and HULKs have it.
    controls.auto_focus = false;
    controls.focus = 0;
  }
  return controls;
}

/// The profile at the image size of `chosen`.
Settings profile_for(const Settings& chosen, const Layers& layers) {
  Settings settings = default_settings(chosen.robot, chosen.camera.position);
  if (!chosen.camera.source.is(drivers::Origin::simulation)) {
    settings.cycle.camera.readout_s =
        geometry::robot_profile(chosen.robot, chosen.camera.position)->readout_s;
  }
  const geometry::CameraModel& profile = settings.rig.camera;
  const auto size = [&layers](std::string_view key, int own, int wanted) {
    return layers.has(key) ? wanted : own;
  };
  const int width_px = size("camera.width_px", profile.width_px, chosen.rig.camera.width_px);
  const int height_px = size("camera.height_px", profile.height_px, chosen.rig.camera.height_px);
  const bool has_intrinsics = layers.has("camera.focal_px") && layers.has("camera.centre_px");
  if (width_px * profile.height_px != height_px * profile.width_px && !has_intrinsics) {
    const std::string_view key =
        layers.has("camera.height_px") ? "camera.height_px" : "camera.width_px";
    refuse(layers, key, base::size_text(width_px, height_px),
           "the aspect of " + base::size_text(profile.width_px, profile.height_px) +
               ", or with camera.focal_px and camera.centre_px");
  }
  scale_intrinsics(settings, width_px, height_px);
  return settings;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code not_there;
  return a == b || std::filesystem::equivalent(a, b, not_there);
}

void check_devices(const Settings& settings, const Layers& layers) {
  using drivers::Origin;
  const drivers::Source &camera = settings.camera.source, &head = settings.head.source;
  if (camera.is(Origin::recording) != head.is(Origin::recording)) {
    const bool is_camera = camera.is(Origin::recording);
    refuse(layers, is_camera ? "camera.source" : "head.source", settings,
           is_camera ? "log:FILE for camera and head (no other head moves as the recorded one did)"
                     : "log:FILE for camera and head (no other camera turns with a recorded head)");
  }
  for (const drivers::Source& source : {camera, head}) {
    if (source.is(Origin::recording) && !settings.run.record.empty() &&
        is_same_file(source.argument(), settings.run.record)) {
      refuse(layers, "run.record", settings, "another file than the log that is read");
    }
  }
}

/// What no key can tell alone.
void check_together(const Settings& settings, const Layers& layers) {
  check_devices(settings, layers);
  const geometry::CameraModel& model = settings.rig.camera;
  if (!model.contains(model.centre_px)) {
    refuse(layers, "camera.centre_px", settings,
           "inside the image, 0 to " + std::to_string(model.width_px - 1) + " and 0 to " +
               std::to_string(model.height_px - 1));
  }
  if (settings.cycle.locate.registration.range_min_m >=
      settings.cycle.locate.registration.range_max_m) {
    refuse(layers, layers.has("locate.range_min_m") ? "locate.range_min_m" : "locate.range_max_m",
           settings, "range_min_m below range_max_m");
  }
  if (settings.cycle.saliency.intensity_weight + settings.cycle.saliency.colour_weight <= 0.0) {
    refuse(layers, "saliency.weights", settings, "at least one above 0");
  }
  if (settings.cycle.saliency.red_green_weight + settings.cycle.saliency.blue_yellow_weight <=
      0.0) {
    refuse(layers, "saliency.opponent_weights", settings,
           "at least one above 0; weights = [1, 0] leaves colour out");
  }
}

}  // namespace

bool runs_fast(const Settings& settings) {
  using drivers::Origin;
  const drivers::Source &camera = settings.camera.source, &head = settings.head.source;
  if (camera.is(Origin::recording)) return true;
  if (!camera.is(Origin::simulation) || !head.is(Origin::simulation)) return false;
  return settings.sim.pace == sim::Pace::fast ||
         (settings.sim.pace == sim::Pace::automatic && settings.run.fixations > 0);
}

Settings default_settings(std::string_view robot, geometry::CameraPosition position) {
  const std::optional<geometry::RobotProfile> profile = geometry::robot_profile(robot, position);
  if (!profile) {
    throw SettingsError("robot: " + base::excerpt(robot) +
                        " found; allowed: " + allowed_text(*find_key("robot")));
  }
  Settings settings;
  settings.robot = profile->name;
  settings.camera.position = position;
  settings.rig = profile->rig;
  settings.cycle.camera.delay_s = profile->delay_s;
  settings.cycle.motion.move_margin_rad = profile->move_margin_rad();
  settings.camera.controls = profile_controls(profile->video);
  return settings;
}

Settings load_settings(const SettingsLayers& sources, const SceneUncertainty& scene_uncertainty,
                       const RecordedConfiguration& recorded_configuration) {
  const Layer environment = layer_of(sources.environment);
  const Layer file = sources.file ? read_toml_file(*sources.file) : Layer{};
  const Layer command_line = layer_of(sources.command_line);
  Layer recorded, scene_layer;
  const auto apply_all = [&] {
    Layers layers;
    layers.add(environment);
    layers.add(recorded);
    layers.add(file);
    layers.add(command_line);
    Settings settings = default_settings();
    layers.apply(settings);
    return std::pair{settings, layers};
  };

  // What the layers are stacked on (robot, position, image size, scene, log) is in the layers
  // itself.
  auto [chosen, without_scene] = apply_all();
  if (chosen.camera.source.is(drivers::Origin::recording) && recorded_configuration) {
    const std::string log = chosen.camera.source.argument();
    recorded = recorded_layer(recorded_configuration(log, chosen.lcm.prefix), log);
    std::tie(chosen, without_scene) = apply_all();
  }

  Layers layers;
  layers.add(environment);
  if (chosen.camera.source.is(drivers::Origin::simulation) && scene_uncertainty) {
    const std::string& scene = chosen.sim.scene;
    scene_layer = layer_of(scene_uncertainty(scene), scene.empty() ? "built-in scene" : scene);
    layers.add(scene_layer);
  }
  layers.add(recorded);
  layers.add(file);
  layers.add(command_line);

  Settings settings = profile_for(chosen, without_scene);
  // A head that was recorded without a word of it did not turn on where a move fell short.
  if (settings.camera.source.is(drivers::Origin::recording)) {
    settings.cycle.motion.move_margin_rad = 0.0;
  }
  layers.apply(settings);
  check_together(settings, layers);
  return settings;
}

}  // namespace gazed::settings
