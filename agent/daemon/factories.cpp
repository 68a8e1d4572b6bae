#include "agent/daemon/factories.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "agent/base/endpoint.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/lcm/lcm_camera.hpp"
#include "drivers/lcm/lcm_head.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"
#include "drivers/lola/lola_head.hpp"
#include "drivers/naoqi/naoqi_camera.hpp"
#include "drivers/naoqi/naoqi_head.hpp"
#include "drivers/naoqi/port.hpp"
#include "drivers/naoqi/release.hpp"
#include "drivers/sim/other_camera.hpp"
#include "drivers/v4l2/v4l2_camera.hpp"

namespace gazed::daemon {

namespace {

using Camera = std::unique_ptr<drivers::CameraDriver>;
using Head = std::unique_ptr<drivers::HeadDriver>;

Camera sim_camera(const Ingredients& from) {
  return std::make_unique<sim::SimCamera>(
      from.sim, sim::other_camera(from.sim->truth().camera, from.settings.rig));
}

Head sim_head(const Ingredients& from) {
  return std::make_unique<sim::SimHead>(from.sim);
}

Camera lcm_camera(const Ingredients& from) {
  const geometry::CameraModel& model = from.settings.rig.camera;
  return std::make_unique<lcm::LcmCamera>(from.link, lcm::Channels(from.settings.lcm),
                                          model.width_px, model.height_px);
}

Head lcm_head(const Ingredients& from) {
  return std::make_unique<lcm::LcmHead>(from.link, lcm::Channels(from.settings.lcm));
}

Camera log_camera(const Ingredients& from) {
  const geometry::CameraModel& model = from.settings.rig.camera;
  return std::make_unique<log::LogCamera>(from.settings.camera.source.argument(),
                                          lcm::Channels(from.settings.lcm), model.width_px,
                                          model.height_px);
}

Head log_head(const Ingredients& from) {
  return std::make_unique<log::LogHead>(from.settings.head.source.argument(),
                                        lcm::Channels(from.settings.lcm));
}

geometry::VideoProfile video_profile(const settings::Settings& settings) {
  return geometry::robot_profile(settings.robot, settings.camera.position).value().video;
}

std::string v4l2_opens(const settings::Settings& settings, drivers::Part) {
  const std::string named = settings.camera.source.argument();
  return named.empty() ? std::string(video_profile(settings).device) : named;
}

v4l2::V4l2Settings v4l2_settings(const settings::Settings& settings) {
  const settings::CameraSettings& camera = settings.camera;
  const std::string device = v4l2_opens(settings, drivers::Part::camera);
  // Another camera's extension unit may do anything, so links and names of the same device count as
  // equal.
  const auto node = [](const std::filesystem::path& path) {
    std::error_code not_there;
    return std::filesystem::weakly_canonical(path, not_there);
  };
  const geometry::VideoProfile robots_own = video_profile(settings);
  return {.device = device,
          .width_px = settings.rig.camera.width_px,
          .height_px = settings.rig.camera.height_px,
          .timing = settings.cycle.camera,
          .controls = camera.controls,
          .flips_by_extension_unit =
              robots_own.flips_by_extension_unit && node(device) == node(robots_own.device),
          .first_frames_dropped = camera.first_frames_dropped};
}

Camera v4l2_camera(const Ingredients& from) {
  return std::make_unique<v4l2::V4l2Camera>(v4l2_settings(from.settings));
}

lola::LolaSettings lola_settings(const settings::Settings& settings) {
  lola::LolaSettings lola = settings.lola;
  const std::string named = settings.head.source.argument();
  if (!named.empty()) lola.socket = named;
  return lola;
}

std::string lola_opens(const settings::Settings& settings, drivers::Part) {
  return lola_settings(settings).socket;
}

Head lola_head(const Ingredients& from) {
  return std::make_unique<lola::LolaHead>(lola_settings(from.settings));
}

// A robot's service manager, and its user, wait for this. LoLA takes 0.75 s: 0.1 s before
// connecting, ten states that must agree, and 0.5 s to lower the head.
constexpr std::chrono::milliseconds release_within{2000};

std::string lola_release(const settings::Settings& settings) {
  return lola::LolaHead(lola_settings(settings)).release(release_within);
}

naoqi::QiRobot naoqi_robot(const settings::Settings& settings, const drivers::Source& source) {
  const std::string named = source.argument();
  const auto directory =
      base::parse_endpoint(named.empty() ? "localhost" : named, naoqi::naoqi_port);
  return {directory.value(), settings.naoqi};
}

Camera naoqi_camera(const Ingredients& from) {
  const settings::CameraSettings& camera = from.settings.camera;
  return std::make_unique<naoqi::NaoqiCamera>(
      naoqi::NaoqiCameraSettings{.robot = naoqi_robot(from.settings, camera.source),
                                 .position = camera.position,
                                 .width_px = from.settings.rig.camera.width_px,
                                 .height_px = from.settings.rig.camera.height_px,
                                 .timing = from.settings.cycle.camera});
}

Head naoqi_head(const Ingredients& from) {
  return std::make_unique<naoqi::NaoqiHead>(
      naoqi::NaoqiHeadSettings{.robot = naoqi_robot(from.settings, from.settings.head.source)});
}

std::string naoqi_opens(const settings::Settings& settings, drivers::Part part) {
  const bool is_camera = part == drivers::Part::camera;
  const naoqi::QiRobot robot =
      naoqi_robot(settings, is_camera ? settings.camera.source : settings.head.source);
  const bool top = settings.camera.position == geometry::CameraPosition::top;
  const char* camera = top ? "top camera" : "bottom camera";
  return "NAOqi at " + base::to_string(robot.directory) + ", " + (is_camera ? camera : "head");
}

std::string naoqi_release(const settings::Settings& settings) {
  return naoqi::release_head(naoqi_robot(settings, settings.head.source), release_within);
}

constexpr auto factories = std::to_array<DriverFactory>({
    {.name = "sim", .camera = sim_camera, .head = sim_head},
    {.name = "lcm", .camera = lcm_camera, .head = lcm_head},
    {.name = "log", .camera = log_camera, .head = log_head},
    {.name = "v4l2", .camera = v4l2_camera, .opens = v4l2_opens},
    {.name = "lola", .head = lola_head, .opens = lola_opens, .release_head = lola_release},
    {.name = "naoqi",
     .camera = naoqi_camera,
     .head = naoqi_head,
     .opens = naoqi_opens,
     .release_head = naoqi_release},
});

}  // namespace

std::span<const DriverFactory> all_factories() {
  return factories;
}

const DriverFactory& factory_of(const drivers::DriverRow& driver) {
  const auto found = std::ranges::find(factories, driver.name, &DriverFactory::name);
  if (found == factories.end())
    throw std::logic_error("the driver " + std::string(driver.name) + " has no factory");
  return *found;
}

}  // namespace gazed::daemon
