// From names to parts: what the configuration calls "sim", "lcm" or "log:FILE" becomes a driver.
#pragma once

#include <optional>
#include <string>

#include "agent/daemon/loop.hpp"
#include "agent/settings/settings.hpp"

namespace gazed::daemon {

/// Opens everything that the configuration names. `lcm_url` is the effective one. Throws
/// std::invalid_argument for what cannot be opened.
[[nodiscard]] LoopParts make_parts(const settings::Settings& settings, const std::string& lcm_url);

/// For --release-head, after a gazed that was killed: makes its head limp, unless
/// head.limp_after_kill says that it stays as it is. Why it is not, in words; empty when all is
/// done. Throws drivers::InUse while another gazed moves it.
[[nodiscard]] std::string release_head(const settings::Settings& settings);

/// Reads the scene and opens nothing else. Throws std::invalid_argument for what make_parts() would
/// refuse.
void check_parts(const settings::Settings& settings);

/// What check_parts() and load_settings() have looked at, in a line for a person; `file` is the
/// configuration's, if there is one.
[[nodiscard]] std::string what_was_checked(const settings::Settings& settings,
                                           const std::optional<std::string>& file);

/// What the scene says about its robot, for load_settings(). "" is the scene that is built in.
[[nodiscard]] geometry::UncertaintyOverride scene_uncertainty(const std::string& scene);

/// What a log was recorded with, for load_settings().
[[nodiscard]] std::string configuration_in_log(const std::string& log_file,
                                               const std::string& prefix);

}  // namespace gazed::daemon
