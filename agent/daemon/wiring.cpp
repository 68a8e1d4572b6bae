#include "agent/daemon/wiring.hpp"

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "drivers/lcm/lcm_camera.hpp"
#include "drivers/lcm/lcm_head.hpp"
#include "drivers/log/log_camera.hpp"
#include "drivers/log/log_head.hpp"
#include "drivers/log/log_reader.hpp"
#include "drivers/lola/lola_head.hpp"
#include "drivers/naoqi/naoqi_camera.hpp"
#include "drivers/naoqi/naoqi_head.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sim_robot.hpp"
#include "drivers/v4l2/nao_cameras.hpp"
#include "drivers/v4l2/v4l2_camera.hpp"

namespace gazed::daemon {

namespace {

sim::Scene scene_of(const std::string& path) {
  return path.empty() ? sim::parse_scene(sim::default_scene_toml(), "built-in scene")
                      : sim::load_scene(path);
}

std::shared_ptr<sim::SimRobot> make_sim_robot(const settings::Settings& settings) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto profile = geometry::robot_profile(settings.robot, settings.camera.position);
  if (!profile)
    throw std::invalid_argument("robot: \"" + settings.robot + "\" found, which is none");
  return std::make_shared<sim::SimRobot>(
      scene_of(settings.sim.scene), *profile, settings.sim.seed,
      std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

std::string video_device(const settings::Settings& settings) {
  const std::string named = settings::split_source(settings.camera.source).argument;
  return named.empty() ? v4l2::nao_camera_device(settings.robot, settings.camera.position) : named;
}

v4l2::V4l2Settings v4l2_settings(const settings::Settings& settings) {
  const settings::CameraSettings& camera = settings.camera;
  const std::string device = video_device(settings);
  // Another camera's extension unit may do anything. By a link or by its own name it is the same.
  const auto node = [](const std::string& path) {
    std::error_code not_there;
    return std::filesystem::weakly_canonical(path, not_there);
  };
  const bool robots_own =
      settings.robot == "nao-v6" &&
      node(device) == node(v4l2::nao_camera_device(settings.robot, camera.position));
  return {.device = device,
          .width_px = camera.model.width_px,
          .height_px = camera.model.height_px,
          .delay_s = camera.delay_s,
          .readout_s = camera.readout_s,
          .timeout_s = camera.timeout_s,
          .controls = camera.controls,
          .flips_by_extension_unit = robots_own};
}

lola::LolaSettings lola_settings(const settings::Settings& settings) {
  lola::LolaSettings lola{.other_joints = settings.head.other_joints};
  const std::string named = settings::split_source(settings.head.source).argument;
  if (!named.empty()) lola.socket = named;
  return lola;
}

base::Endpoint naoqi_directory(const settings::Source& source) {
  const std::string place = source.argument.empty() ? "localhost" : source.argument;
  const auto directory = base::parse_endpoint(place, settings::naoqi_port);
  if (!directory)
    throw std::invalid_argument("naoqi: \"" + place + "\" found; allowed: ADDRESS[:PORT]");
  return *directory;
}

naoqi::QiRobot naoqi_robot(const settings::Settings& settings, const settings::Source& source) {
  return {naoqi_directory(source), settings.naoqi.user, settings.naoqi.token};
}

/// What no second gazed may use, of a robot's NAOqi.
std::string naoqi_part(const settings::Source& source, const std::string& part) {
  return "NAOqi at " + base::to_string(naoqi_directory(source)) + ", " + part;
}

naoqi::NaoqiCameraSettings naoqi_camera(const settings::Settings& settings,
                                        const settings::Source& source) {
  const settings::CameraSettings& camera = settings.camera;
  return {.robot = naoqi_robot(settings, source),
          .position = camera.position,
          .width_px = camera.model.width_px,
          .height_px = camera.model.height_px,
          .delay_s = camera.delay_s,
          .timeout_s = camera.timeout_s};
}

/// What no second gazed may use beside this one.
std::vector<drivers::ExclusiveUse> keep_to_ourselves(const settings::Settings& settings) {
  std::vector<drivers::ExclusiveUse> in_use;
  const settings::Source camera = settings::split_source(settings.camera.source);
  const settings::Source head = settings::split_source(settings.head.source);
  if (camera.driver == "v4l2") in_use.emplace_back(video_device(settings));
  if (camera.driver == "naoqi") {
    const bool top = settings.camera.position == geometry::CameraPosition::top;
    in_use.emplace_back(naoqi_part(camera, top ? "top camera" : "bottom camera"));
  }
  if (head.driver == "lola") in_use.emplace_back(lola_settings(settings).socket);
  if (head.driver == "naoqi") in_use.emplace_back(naoqi_part(head, "head"));
  return in_use;
}

std::unique_ptr<drivers::CameraDriver> make_camera(const settings::Settings& settings,
                                                   lcm::LcmLink& link,
                                                   const std::shared_ptr<sim::SimRobot>& sim) {
  const settings::Source source = settings::split_source(settings.camera.source);
  const lcm::Channels channels(settings.lcm.prefix);
  const geometry::CameraModel& model = settings.camera.model;
  if (source.driver == "sim") return std::make_unique<sim::SimCamera>(sim);
  if (source.driver == "lcm")
    return std::make_unique<lcm::LcmCamera>(link, channels, model.width_px, model.height_px);
  if (source.driver == "v4l2") return std::make_unique<v4l2::V4l2Camera>(v4l2_settings(settings));
  if (source.driver == "naoqi")
    return std::make_unique<naoqi::NaoqiCamera>(naoqi_camera(settings, source));
  return std::make_unique<log::LogCamera>(source.argument, channels, model.width_px,
                                          model.height_px);
}

std::unique_ptr<drivers::HeadDriver> make_head(const settings::Settings& settings,
                                               lcm::LcmLink& link,
                                               const std::shared_ptr<sim::SimRobot>& sim) {
  const settings::Source source = settings::split_source(settings.head.source);
  const lcm::Channels channels(settings.lcm.prefix);
  if (source.driver == "sim") return std::make_unique<sim::SimHead>(sim);
  if (source.driver == "lcm") return std::make_unique<lcm::LcmHead>(link, channels);
  if (source.driver == "lola") return std::make_unique<lola::LolaHead>(lola_settings(settings));
  if (source.driver == "naoqi")
    return std::make_unique<naoqi::NaoqiHead>(
        naoqi::NaoqiHeadSettings{.robot = naoqi_robot(settings, source)});
  return std::make_unique<log::LogHead>(source.argument, channels);
}

/// A recording is handed on; who gazed is to the robot is not.
std::string configuration_to_record(settings::Settings settings) {
  settings.naoqi = {};
  return settings::to_toml(settings);
}

}  // namespace

cycle::CycleSettings cycle_settings(const settings::Settings& settings, bool head_obeys) {
  return {.camera = settings.camera.model,
          .head = settings.head.geometry,
          .uncertainty = settings.uncertainty,
          .limits = geometry::HeadLimits(settings.head.margin_rad),
          .saliency = settings.saliency,
          .registration = {.range_min_m = settings.locate.range_min_m,
                           .range_max_m = settings.locate.range_max_m},
          .gate = {.relative_sigma_max = settings.locate.relative_sigma_max},
          .looks = settings.locate.looks,
          .plan = settings.locate.plan,
          .speed_fraction = settings.head.speed_fraction,
          .settle_velocity_rad_s = settings.head.settle_velocity_rad_s,
          .settle_tolerance_rad = settings.head.settle_tolerance_rad,
          .settle_timeout_s = settings.head.settle_timeout_s,
          .camera_timeout_s = settings.camera.timeout_s,
          .head_obeys = head_obeys,
          .readout_s = settings.camera.readout_s};
}

LoopParts make_parts(const settings::Settings& settings, const std::string& lcm_url) {
  LoopParts parts;
  const bool camera_is_sim = settings.camera.source == "sim",
             head_is_sim = settings.head.source == "sim";
  std::shared_ptr<sim::SimRobot> sim;
  if (camera_is_sim || head_is_sim) sim = make_sim_robot(settings);
  parts.in_use = keep_to_ourselves(settings);
  parts.link = std::make_unique<lcm::LcmLink>(lcm_url);
  parts.camera = make_camera(settings, *parts.link, sim);
  parts.head = make_head(settings, *parts.link, sim);
  if (sim) parts.scene_goes_on = [sim] { sim->next_test(); };
  if (camera_is_sim && !head_is_sim)
    parts.camera_follows = [sim](const geometry::HeadState& state) { sim->observe(state); };
  if (!settings.run.record.empty()) {
    parts.recorder = std::make_unique<log::LogWriter>(
        settings.run.record, lcm::Channels(settings.lcm.prefix), configuration_to_record(settings));
  }
  return parts;
}

void check_scene(const settings::Settings& settings) {
  if (settings.camera.source == "sim" || settings.head.source == "sim")
    (void)scene_of(settings.sim.scene);
}

geometry::UncertaintyOverride scene_uncertainty(const std::string& scene) {
  return scene_of(scene).uncertainty;
}

std::string configuration_in_log(const std::string& log_file, const std::string& prefix) {
  return log::recorded_configuration(log_file, lcm::Channels(prefix));
}

}  // namespace gazed::daemon
