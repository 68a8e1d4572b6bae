// Turns the names in a configuration ("sim", "lcm", "log:FILE") into drivers.
#pragma once

#include <optional>
#include <string>

#include "agent/daemon/loop.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::daemon {

/// Opens everything that the configuration names. `lcm_url` is the effective one. Throws
/// std::invalid_argument if something cannot be opened.
[[nodiscard]] LoopParts make_parts(const settings::Settings& settings, const std::string& lcm_url);

/// For --release-head, after a gazed was killed: makes its head limp, unless head.limp_after_kill
/// forbids it. Returns why that failed; empty on success. Throws drivers::InUse while another gazed
/// moves the head.
[[nodiscard]] std::string release_head(const settings::Settings& settings);

/// Reads the scene and opens nothing else. Throws std::invalid_argument where make_parts() would.
void check_parts(const settings::Settings& settings);

/// What check_parts() and load_settings() have checked, in one line for the user; `file` is the
/// configuration file, if there is one.
[[nodiscard]] std::string what_was_checked(const settings::Settings& settings,
                                           const std::optional<std::string>& file);

/// What the scene says about its robot, for load_settings(). "" is the built-in scene.
[[nodiscard]] geometry::UncertaintyOverride scene_uncertainty(const std::string& scene);

/// The configuration with which a log was recorded, for load_settings().
[[nodiscard]] std::string configuration_in_log(const std::string& log_file,
                                               const std::string& prefix);

}  // namespace gazed::daemon
