// From names to parts: what the configuration calls "sim", "lcm" or "log:FILE" becomes a driver,
// and the daemon's settings those of the cycle.
#pragma once

#include <string>

#include "agent/daemon/loop.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::daemon {

/// `head_obeys`: as the head's driver says.
[[nodiscard]] cycle::CycleSettings cycle_settings(const settings::Settings& settings,
                                                  bool head_obeys);

/// Opens everything that the configuration names. `lcm_url` is the effective one. Throws
/// std::invalid_argument for what cannot be opened.
[[nodiscard]] LoopParts make_parts(const settings::Settings& settings, const std::string& lcm_url);

/// Reads the scene, opens nothing else. Throws std::invalid_argument for what is wrong in it.
void check_scene(const settings::Settings& settings);

/// What the scene says about its robot, for load_settings(). "" is the scene that is built in.
[[nodiscard]] geometry::UncertaintyOverride scene_uncertainty(const std::string& scene);

/// What a log was recorded with, for load_settings().
[[nodiscard]] std::string configuration_in_log(const std::string& log_file,
                                               const std::string& prefix);

}  // namespace gazed::daemon
