#include "agent/daemon/wiring.hpp"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "agent/daemon/factories.hpp"
#include "drivers/log/log_reader.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sim_robot.hpp"

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

/// What no second gazed may use beside this one.
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
  const bool camera_is_sim = settings.camera.source.is(drivers::Origin::simulation);
  const bool head_is_sim = settings.head.source.is(drivers::Origin::simulation);
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
  if (!settings.run.record.empty()) {
    parts.recorder = std::make_unique<log::LogWriter>(
        settings.run.record, lcm::Channels(settings.lcm.prefix), configuration_to_record(settings));
  }
  return parts;
}

void check_scene(const settings::Settings& settings) {
  const auto is_sim = [](const drivers::Source& source) {
    return source.is(drivers::Origin::simulation);
  };
  if (is_sim(settings.camera.source) || is_sim(settings.head.source))
    (void)scene_of(settings.sim.scene);
}

geometry::UncertaintyOverride scene_uncertainty(const std::string& scene) {
  return scene_of(scene).uncertainty;
}

std::string configuration_in_log(const std::string& log_file, const std::string& prefix) {
  return log::recorded_configuration(log_file, lcm::Channels(prefix));
}

}  // namespace gazed::daemon
