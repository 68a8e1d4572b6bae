#include "tests/unit/agent/cycle/simulated_head.hpp"

#include <cstdint>

#include "agent/geometry/robot.hpp"

#include "tests/unit/trials.hpp"

namespace gazed::cycle {

namespace {

/// Where a frame is the work of a second, fewer of them are made.
sim::Scene scene_of(std::string_view toml) {
  sim::Scene scene = sim::parse_scene(toml, "test scene");
  if (test::few_trials) scene.camera.fps = 10.0;
  return scene;
}

}  // namespace

SimulatedHead::SimulatedHead(std::string_view scene_toml, const HeadSetup& setup)
    : robot(std::make_shared<sim::SimRobot>(scene_of(scene_toml),
                                            *geometry::robot_profile("nao-v6"), 1, 1'000'000)),
      cycle(setup.made()) {}

std::optional<Fixation> SimulatedHead::run(double seconds) {
  const std::int64_t end_us = robot->now_us() + static_cast<std::int64_t>(1e6 * seconds);
  while (robot->now_us() < end_us) {
    const auto state_us = robot->next_state_utime_us();
    const auto frame_us = robot->next_frame_utime_us();
    CycleOutput output;
    if (state_us && (!frame_us || *state_us <= *frame_us)) {
      const geometry::HeadState state = measured(*robot->next_state());
      output = cycle.on_head_state(state);
    } else if (const auto frame = robot->next_frame([this](std::int64_t utime_us) {
                 return draws_all || cycle.may_look_at_frame(utime_us);
               })) {
      output = cycle.on_frame(seen(*frame));
    }
    if (output.saliency) looked(*output.saliency);
    if (output.command) {
      ++commands;
      if (obeys) robot->command(*output.command);
      commanded(*output.command);
    }
    if (output.fixation) return output.fixation;
  }
  return std::nullopt;
}

HeadSetup calibrated_nao_v6() {
  HeadSetup setup;
  setup.rig = geometry::robot_profile("nao-v6")->rig;
  setup.cycle.motion.margin_rad = 0.0;
  setup.cycle.locate.looks = 2;
  // The default scene's calibrated robot.
  setup.rig.uncertainty.focal_sigma_px = 0.5;
  setup.rig.uncertainty.centre_sigma_px = 1.0;
  setup.rig.uncertainty.mount_offset_sigma_m = 0.001;
  setup.rig.uncertainty.mount_rotation_sigma_rad = 0.003;
  setup.rig.uncertainty.zero_sigma_rad = 0.003;
  return setup;
}

}  // namespace gazed::cycle
