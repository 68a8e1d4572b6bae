// A cycle closed over the simulated robot, with a hand in between: a test can change what the head
// says, drop what it is told, or stop the world.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "agent/cycle/cycle.hpp"
#include "agent/cycle/head_history.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::cycle {

// Perfect joints and a noisy camera: what fails then is the cycle's own doing.
inline constexpr std::string_view report_test_1 =
    "[camera]\npixel_noise = 2.0\n[[report_test]]\nnumber = 1\n";
inline constexpr std::string_view bare_wall =
    "[camera]\npixel_noise = 2.0\n[[target_test]]\nposition_m = [-2.0, 0.0, 0.0]\n";

/// All that a cycle is made of.
struct HeadSetup {
  geometry::Rig rig;
  CycleSettings cycle;
  HeadLink head;

  [[nodiscard]] Cycle made() const { return {rig, cycle, head}; }
};

class SimulatedHead {
 public:
  SimulatedHead(std::string_view scene_toml, const HeadSetup& setup);

  /// Serves events until a fixation is published or `seconds` have passed.
  std::optional<Fixation> run(double seconds = 10.0);

  std::shared_ptr<sim::SimRobot> robot;
  Cycle cycle;
  bool obeys = true;  // commands reach the joints
  std::function<geometry::HeadState(geometry::HeadState)> measured =
      [](const geometry::HeadState& state) { return state; };
  bool draws_all = false;  // also frames that nobody will look at, as their times are
  std::function<geometry::Frame(const geometry::Frame&)> seen = [](const geometry::Frame& frame) {
    return frame;
  };
  std::function<void(const UsedSaliency&)> looked = [](const UsedSaliency&) {};
  std::function<void(const geometry::HeadCommand&)> commanded = [](const geometry::HeadCommand&) {
  };  // after each
  int commands = 0;
};

/// A calibrated nao-v6 that knows its simulated body; two looks, by the report's rule.
[[nodiscard]] HeadSetup calibrated_nao_v6();

}  // namespace gazed::cycle
