// Simulated robots for tests, and how the loop serves them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::sim::robots {

inline constexpr std::int64_t start_us = 1'700'000'000'000'000;

inline std::shared_ptr<SimRobot> robot_in(const std::string& scene, std::uint64_t seed = 1) {
  return std::make_shared<SimRobot>(parse_scene(scene, "test.toml"),
                                    *geometry::robot_profile("nao-v6"), seed, start_us);
}

/// A small camera keeps the tests quick.
inline const std::string small = "[camera]\nwidth_px = 160\nheight_px = 120\n";
inline const std::string one_test = "[[report_test]]\nnumber = 1\n";

inline std::vector<std::uint8_t> bytes(const geometry::Frame& frame) {
  const int size = frame.image.row_stride * frame.image.height_px;
  return {frame.image.data, frame.image.data + size};
}

/// Serves events in order up to a time, as the loop does.
inline void run_until(SimRobot& robot, std::int64_t utime_us) {
  while (true) {
    const auto frame_us = robot.next_frame_utime_us(), state_us = robot.next_state_utime_us();
    if (!frame_us || !state_us || std::min(*frame_us, *state_us) > utime_us) return;
    if (*state_us <= *frame_us)
      (void)robot.next_state();
    else
      (void)robot.next_frame();
  }
}

}  // namespace gazed::sim::robots
