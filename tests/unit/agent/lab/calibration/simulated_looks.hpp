// Pictures that a simulated robot takes at a list of head angles, and what is true of it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "agent/lab/calibration/head_pictures.hpp"
#include "drivers/sim/sim_robot.hpp"

namespace gazed::lab::calibration {

struct SimulatedLooks {
  std::vector<HeadPicture> pictures;
  std::vector<geometry::HeadAngles> true_angles;
  sim::SimTruth truth;
};

/// A V6 in the room that the TOML text describes is told to look at each of `targets`, and takes a
/// picture when it is still.
[[nodiscard]] SimulatedLooks simulated_looks(const std::string& scene,
                                             std::span<const geometry::HeadAngles> targets);

/// The same as an LCM log, with everything that camera and head said on the way.
void write_simulated_log(const std::string& scene, std::span<const geometry::HeadAngles> targets,
                         const std::filesystem::path& log);

/// Rows of `pitches` x `yaws` angles, both spread evenly over +- the greatest, pitch about a
/// middle; each second row goes back.
[[nodiscard]] std::vector<geometry::HeadAngles> grid_of_looks(int yaws, double greatest_yaw_rad,
                                                              int pitches,
                                                              double greatest_pitch_rad,
                                                              double middle_pitch_rad);

}  // namespace gazed::lab::calibration
