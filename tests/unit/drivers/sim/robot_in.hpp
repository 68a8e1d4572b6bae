// A simulated robot in a scene, for the tests of SimRobot.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "agent/base/image.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/robot.hpp"
#include "drivers/sim/scene.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::sim::testing {

constexpr std::int64_t start_us = 1'700'000'000'000'000;

inline std::shared_ptr<SimRobot> robot_in(const std::string& scene, std::uint64_t seed = 1) {
  return std::make_shared<SimRobot>(parse_scene(scene, "test.toml"),
                                    *geometry::robot_profile("nao-v6"), seed, start_us);
}

/// A small camera keeps the tests quick.
inline const std::string small = "[camera]\nwidth_px = 160\nheight_px = 120\n";
inline const std::string one_test = "[[report_test]]\nnumber = 1\n";

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

/// Centre of what is red.
inline geometry::Pixel red_centre(const base::ImageView& image) {
  double weight = 0.0;
  geometry::Pixel sum = geometry::Pixel::Zero();
  for (int y = 0; y < image.height_px; ++y)
    for (int x = 0; x < image.width_px; ++x) {
      const std::uint8_t* p = image.row(y) + 3 * x;
      const double red = std::max(0, p[0] - (p[1] + p[2]) / 2 - 20);
      weight += red;
      sum += red * geometry::Pixel(x, y);
    }
  return sum / weight;
}

}  // namespace gazed::sim::testing
