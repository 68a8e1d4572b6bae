// The configuration of gazed: one struct a table of the TOML file, and how the layers that decide
// it are read.
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

#include "agent/gaze/planner.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/geometry/robot.hpp"
#include "agent/saliency/saliency.hpp"
#include "drivers/lola/other_joints.hpp"
#include "drivers/table.hpp"
#include "drivers/v4l2/camera_controls.hpp"

namespace gazed::settings {

struct CameraSettings {
  drivers::Source source;
  geometry::CameraPosition position = geometry::CameraPosition::top;
  geometry::CameraModel model;
  double readout_s = 0.0;  // rolling shutter: first row to last; 0: all rows at once
  double delay_s = 0.0;    // added to the driver's time stamp to give the start of exposure
  /// This long without a frame is CAMERA_FAULT; B-Human 2024 reopens its camera after 2000 ms.
  double timeout_s = 2.0;
  v4l2::CameraControls controls;
};

struct HeadSettings {
  drivers::Source source;
  geometry::HeadGeometry geometry;  // its mount is that of the camera; the keys are in [camera]
  /// Kept from every joint limit. Joints miss a command by up to 0.02 rad (Russcher 2011, chapter
  /// 5), and the V6's table of limits is reported as too wide (HULKs/hulk #203): 0.01 rad more.
  double margin_rad = 0.03;
  /// Of each joint's no-load speed. 0.3 is 2.5 rad/s in yaw, well below the loaded speed (6.1
  /// rad/s, Aldebaran documentation, "Motors"): joints still follow their command, and a step of
  /// 0.1 rad takes less than two frames.
  double speed_fraction = 0.3;
  double settle_velocity_rad_s = 0.1;  // below it, for two samples, the head is still
  double settle_tolerance_rad = 0.05;  // of a still and driven head from its command; more where it
                                       // is told to measure badly (CycleSettings)
  double settle_timeout_s = 3.0;       // not settled by then is HEAD_FAULT
  bool hold = true;                    // at the end the head stops where it is
  lola::OtherJoints other_joints =
      lola::OtherJoints::hold;  // lola: what it tells the rest of the body
};

struct LocateSettings {
  int looks = 2;                     // at one target, fused; with the first
  double relative_sigma_max = 0.15;  // of the inverse range; above it a point is UNCERTAIN
  double range_min_m = 0.1;          // view 2 is searched for ranges from here
  double range_max_m = 10.0;         // to here
  gaze::Plan plan = gaze::Plan::report;
};

struct LcmSettings {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";  // LCM's own default
  std::string prefix = "GAZED";                         // of every channel
};

struct PublishSettings {
  bool images = false;
  bool saliency = true;
};

enum class PrintFormat : std::uint8_t { text, json, none };

struct RunSettings {
  int fixations = 0;  // end after this many; 0: never
  PrintFormat print = PrintFormat::text;
  std::string record;  // log file that every consumed frame and head state goes to; empty: none
};

enum class Pace : std::uint8_t { automatic, fast, real };

struct SimSettings {
  std::string scene;  // file; empty: the scene that is built in
  std::uint32_t seed = 1;
  Pace pace = Pace::automatic;
};

struct NaoqiSettings {
  std::string user;
  std::string token;
};

struct Settings {
  std::string robot = "nao-v6";
  CameraSettings camera;
  HeadSettings head;
  geometry::Uncertainty uncertainty;
  saliency::SaliencySettings saliency;
  LocateSettings locate;
  LcmSettings lcm;
  PublishSettings publish;
  RunSettings run;
  SimSettings sim;
  NaoqiSettings naoqi;
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
/// shutter is the scene's and not the robot's. `robot` is one of robot_names();
/// throws SettingsError otherwise.
[[nodiscard]] Settings default_settings(
    std::string_view robot = "nao-v6",
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
[[nodiscard]] Settings load_settings(const SettingsLayers& layers,
                                     const SceneUncertainty& scene_uncertainty,
                                     const RecordedConfiguration& recorded_configuration = {});

/// All keys as a TOML file that load_settings reads back as the same settings.
[[nodiscard]] std::string to_toml(const Settings& settings);

}  // namespace gazed::settings
