// The configuration of gazed: the settings of its parts, and how the layers that decide them are
// read. The table of keys (table.hpp) says which field a key stands for.
//
// Vocabulary. A key is a TOML path, "camera.width_px". A layer is a set of values for keys; of two
// layers the later wins.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "agent/cycle/settings.hpp"
#include "agent/geometry/rig.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/settings/run_settings.hpp"
#include "drivers/lcm/settings.hpp"
#include "drivers/lola/settings.hpp"
#include "drivers/naoqi/settings.hpp"
#include "drivers/sim/settings.hpp"
#include "drivers/table.hpp"
#include "drivers/v4l2/camera_controls.hpp"

namespace gazed::settings {

struct CameraSettings {
  drivers::Source source;
  geometry::CameraPosition position = geometry::CameraPosition::top;
  v4l2::CameraControls controls;
  int first_frames_dropped = 4;  // v4l2: a choice, 0.13 s at 30 Hz
};

struct HeadSettings {
  drivers::Source source;
  bool hold = true;             // at the end the head stops where it is
  bool limp_after_kill = true;  // --release-head takes it its stiffness
};

inline constexpr std::string_view default_robot = "nao-v6";

/// Everything. Most parts define their own settings, and their defaults, in their own folder;
/// those that depend on the robot are default_settings()'s.
struct Settings {
  std::string robot{default_robot};
  geometry::Rig rig;
  CameraSettings camera;
  HeadSettings head;
  cycle::CycleSettings cycle;
  lcm::LcmSettings lcm;
  PublishSettings publish;
  RunSettings run;
  sim::SimSettings sim;
  lola::LolaSettings lola;
  naoqi::NaoqiLogin naoqi;
};

/// A configuration that cannot be used. what() names the place (file and line, or option), the key,
/// the value found and the values allowed:
///   robot.toml:12: camera.width_px: 12 found; allowed: 160 to 2560
class SettingsError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// True when events are not waited for: of a log never, of the simulator when camera and head are
/// both simulated and the pace is fast, or automatic with a number of fixations to make.
[[nodiscard]] bool runs_fast(const Settings& settings);

/// What is known of a robot before anybody configures anything: with a simulated camera, whose
/// shutter is the scene's and not the robot's. `robot` is one of robot_names;
/// throws SettingsError otherwise.
[[nodiscard]] Settings default_settings(
    std::string_view robot = default_robot,
    geometry::CameraPosition position = geometry::CameraPosition::top);

/// How a text stands for a value: as it is, or with quotes, brackets and points as in a TOML file.
enum class Written : std::uint8_t { plainly, as_toml };

/// A value for a key from outside the file, still as text.
struct Assignment {
  std::string key;
  std::string text;
  std::string where;  // what an error names: "--camera", "LCM_DEFAULT_URL"
  Written written = Written::plainly;
};

/// The layers above a robot's profile, the first the weakest.
struct SettingsLayers {
  std::vector<Assignment> environment;
  std::optional<std::string> file;  // TOML
  std::vector<Assignment> command_line;
};

/// The [uncertainty] that a scene's file states for its robot; "" is the scene that is built in.
using SceneUncertainty = std::function<geometry::UncertaintyOverride(const std::string& scene)>;

/// The configuration that a log was recorded with, as TOML; empty when the log has none.
using RecordedConfiguration =
    std::function<std::string(const std::string& log_file, const std::string& prefix)>;

/// Robot profile < environment < scene's [uncertainty] (camera sim) or what a log was recorded with
/// (camera log: robot, camera, head, uncertainty, saliency, locate; not the sources) < file <
/// command line. The profile's focal length and centre are scaled to the configured image size when
/// its aspect is the profile's. Throws SettingsError.
[[nodiscard]] Settings load_settings(const SettingsLayers& sources,
                                     const SceneUncertainty& scene_uncertainty,
                                     const RecordedConfiguration& recorded_configuration = {});

/// All keys as a TOML file that load_settings reads back as the same settings.
[[nodiscard]] std::string to_toml(const Settings& settings);

}  // namespace gazed::settings
