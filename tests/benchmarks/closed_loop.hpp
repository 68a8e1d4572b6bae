// One fixation of the daemon's cycle on the simulated robot, and what is true about it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "agent/cycle/cycle.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::benchmarks {

struct JudgedFixation {
  cycle::Fixation fixation;
  /// Of the scene point under pixel_1, along the true ray of the camera that took view 1, as it was
  /// when pixel_1's row was exposed; none without a view or where the ray meets nothing.
  std::optional<sim::Hit> truth;
  /// Between the published and the true point, seen from where camera 1 truly was.
  double bearing_error_rad = triangulation::not_a_number;
  double cycle_ms = 0.0;   // CPU time of the cycle for all of the fixation
  double locate_ms = 0.0;  // for the input that ended it
};

class ClosedLoop {
 public:
  ClosedLoop(sim::Scene scene, const geometry::RobotProfile& profile, const geometry::Rig& believed,
             const cycle::CycleSettings& settings, std::uint64_t seed);

  /// Runs until the next fixation is published, then lets the scene go on. Throws
  /// std::runtime_error when none is within two minutes of the robot's time.
  [[nodiscard]] JudgedFixation next();
  /// Of the fixation that next() will return, counted from 0.
  [[nodiscard]] std::size_t test() const { return robot_.truth().test; }

 private:
  /// The next head state or frame; adds up its CPU time.
  [[nodiscard]] cycle::CycleOutput serve(JudgedFixation& judged);
  void judge(JudgedFixation& judged) const;

  sim::SimRobot robot_;
  cycle::Cycle cycle_;
  std::optional<std::int64_t> view_1_us_;  // its frame's time stamp
};

}  // namespace gazed::benchmarks
