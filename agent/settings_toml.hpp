// The configuration as a TOML file.
#pragma once

#include <string>
#include <vector>

#include "agent/settings_table.hpp"

namespace gazed {

/// The entries of a file, in the order of their paths. Types and ranges are not yet checked. Throws
/// SettingsError: not readable, longer than 64 KiB, not TOML, an unknown key.
[[nodiscard]] std::vector<Entry> read_toml_file(const std::string& file);

}  // namespace gazed
