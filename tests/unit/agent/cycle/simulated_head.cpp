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

SimulatedHead::SimulatedHead(std::string_view scene_toml, const Parts& parts)
    : robot(std::make_shared<sim::SimRobot>(scene_of(scene_toml),
                                            *geometry::robot_profile("nao-v6"), 1, 1'000'000)),
      cycle(parts.made()),
      history_(parts.cycle.motion.settle_velocity_rad_s) {}

bool SimulatedHead::passes_frame() const {
  const bool moves = cycle.state() == CycleState::turning || cycle.state() == CycleState::settling;
  return test::few_trials && moves && !history_.still_now();
}

std::optional<Fixation> SimulatedHead::run(double seconds) {
  const std::int64_t end_us = robot->now_us() + static_cast<std::int64_t>(1e6 * seconds);
  while (robot->now_us() < end_us) {
    const auto state_us = robot->next_state_utime_us();
    const auto frame_us = robot->next_frame_utime_us();
    CycleOutput output;
    if (state_us && (!frame_us || *state_us <= *frame_us)) {
      const geometry::HeadState state = measured(*robot->next_state());
      static_cast<void>(history_.add(state));
      output = cycle.on_head_state(state);
    } else if (passes_frame()) {
      robot->pass_frame();
    } else if (const auto frame = robot->next_frame()) {
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

Parts calibrated_nao_v6() {
  Parts parts;
  parts.rig = geometry::robot_profile("nao-v6")->rig;
  parts.cycle.motion.margin_rad = 0.0;
  // The default scene's calibrated robot.
  parts.rig.uncertainty.focal_sigma_px = 0.5;
  parts.rig.uncertainty.centre_sigma_px = 1.0;
  parts.rig.uncertainty.mount_offset_sigma_m = 0.001;
  parts.rig.uncertainty.mount_rotation_sigma_rad = 0.003;
  parts.rig.uncertainty.zero_sigma_rad = 0.003;
  return parts;
}

}  // namespace gazed::cycle
