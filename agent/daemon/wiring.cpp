#include "agent/daemon/wiring.hpp"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "agent/base/image.hpp"
#include "agent/base/text.hpp"
#include "agent/daemon/factories.hpp"
#include "drivers/log/log_file.hpp"
#include "drivers/log/log_reader.hpp"
#include "drivers/log/recorder.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::daemon {

namespace {

sim::Scene scene_of(const std::string& path) {
  return path.empty() ? sim::parse_scene(sim::default_scene_toml(), "built-in scene")
                      : sim::load_scene(path);
}

bool is_simulated(const drivers::Source& source) {
  return source.is(drivers::Origin::simulation);
}

geometry::RobotProfile profile_of(const settings::Settings& settings) {
  const auto profile = geometry::robot_profile(settings.robot, settings.camera.position);
  if (!profile)
    throw std::invalid_argument("robot: \"" + settings.robot + "\" found, which is none");
  return *profile;
}

/// Otherwise all frames would be refused for having another size than configured.
sim::Scene scene_to_play(const settings::Settings& settings) {
  sim::Scene scene = scene_of(settings.sim.scene);
  const geometry::CameraModel profile = profile_of(settings).rig.camera;
  const geometry::CameraModel& configured = settings.rig.camera;
  const int width_px = scene.camera.width_px.value_or(profile.width_px);
  const int height_px = scene.camera.height_px.value_or(profile.height_px);
  if (is_simulated(settings.camera.source) &&
      (width_px != configured.width_px || height_px != configured.height_px)) {
    throw std::invalid_argument("camera.width_px, camera.height_px: " +
                                base::size_text(configured.width_px, configured.height_px) +
                                " found; allowed: " + base::size_text(width_px, height_px) +
                                ", as the scene's camera has it ([camera] width_px and " +
                                "height_px of a scene)");
  }
  return scene;
}

std::shared_ptr<sim::SimRobot> make_sim_robot(const settings::Settings& settings) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::make_shared<sim::SimRobot>(
      scene_to_play(settings), profile_of(settings), settings.sim.seed,
      std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

/// Resources that a second gazed must not use at the same time.
std::vector<drivers::ExclusiveUse> keep_to_ourselves(const settings::Settings& settings) {
  std::vector<drivers::ExclusiveUse> in_use;
  const auto keep = [&](const drivers::Source& source, drivers::Part part) {
    if (source.driver().exclusive)
      in_use.emplace_back(factory_of(source.driver()).opens(settings, part));
  };
  keep(settings.camera.source, drivers::Part::camera);
  keep(settings.head.source, drivers::Part::head);
  return in_use;
}

/// A recording may be passed on, so it must not contain the robot's login.
std::string configuration_to_record(settings::Settings settings) {
  settings.naoqi = {};
  return settings::to_toml(settings);
}

std::unique_ptr<log::Recorder> make_recorder(const settings::Settings& settings) {
  if (settings.run.record.empty()) return nullptr;
  const geometry::CameraModel& camera = settings.rig.camera;
  return std::make_unique<log::Recorder>(
      log::RecorderSettings{.path = settings.run.record,
                            .keep_bytes = settings.run.record_keep_bytes,
                            .frame_bytes_max = static_cast<std::size_t>(base::bytes_per_pixel(
                                                   base::PixelFormat::rgb24)) *
                                               static_cast<std::size_t>(camera.width_px) *
                                               static_cast<std::size_t>(camera.height_px),
                            .configuration = configuration_to_record(settings)},
      lcm::Channels(settings.lcm.prefix));
}

}  // namespace

LoopParts make_parts(const settings::Settings& settings, const std::string& lcm_url) {
  LoopParts parts;
  // Its process is a fork of this one: create it before this one grows or liblcm starts threads.
  parts.recorder = make_recorder(settings);
  const bool camera_is_sim = is_simulated(settings.camera.source);
  const bool head_is_sim = is_simulated(settings.head.source);
  std::shared_ptr<sim::SimRobot> sim;
  if (camera_is_sim || head_is_sim) sim = make_sim_robot(settings);
  parts.in_use = keep_to_ourselves(settings);
  parts.link = std::make_unique<lcm::LcmLink>(lcm_url);
  const Ingredients ingredients{settings, *parts.link, sim};
  parts.camera = factory_of(settings.camera.source.driver()).camera(ingredients);
  parts.head = factory_of(settings.head.source.driver()).head(ingredients);
  if (sim) parts.scene_goes_on = [sim] { sim->next_test(); };
  if (camera_is_sim && !head_is_sim)
    parts.camera_follows = [sim](const geometry::HeadState& state) { sim->observe(state); };
  return parts;
}

std::string release_head(const settings::Settings& settings) {
  const DriverFactory& factory = factory_of(settings.head.source.driver());
  if (!settings.head.limp_after_kill || factory.release_head == nullptr) return {};
  const drivers::ExclusiveUse use(factory.opens(settings, drivers::Part::head));
  return factory.release_head(settings);
}

void check_parts(const settings::Settings& settings) {
  if (is_simulated(settings.camera.source) || is_simulated(settings.head.source))
    (void)scene_to_play(settings);
  if (!settings.run.record.empty()) log::refuse_what_is_no_file(settings.run.record);
}

std::string what_was_checked(const settings::Settings& settings,
                             const std::optional<std::string>& file) {
  std::string line = "checked: " + (file ? *file : std::string("no configuration file")) +
                     ", robot " + settings.robot + ", camera " + settings.camera.source.text() +
                     ", head " + settings.head.source.text();
  if (is_simulated(settings.camera.source) || is_simulated(settings.head.source)) {
    line +=
        settings.sim.scene.empty() ? ", the built-in scene" : ", the scene " + settings.sim.scene;
  }
  if (!settings.run.record.empty()) line += ", recording to " + settings.run.record;
  return line + ": all values are allowed; nothing was opened";
}

geometry::UncertaintyOverride scene_uncertainty(const std::string& scene) {
  return scene_of(scene).uncertainty;
}

std::string configuration_in_log(const std::string& log_file, const std::string& prefix) {
  return log::recorded_configuration(log_file, prefix);
}

}  // namespace gazed::daemon
