// The configuration as a TOML file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "agent/settings/table.hpp"

namespace gazed::settings {

/// The entries of a text, in the order of their paths; `name` is what errors call it. Types and
/// ranges are not yet checked. Throws SettingsError: longer than 64 KiB, not TOML, an unknown key.
[[nodiscard]] std::vector<Entry> read_toml(std::string_view text, const std::string& name);

/// The same of a file. Throws SettingsError also when it cannot be read.
[[nodiscard]] std::vector<Entry> read_toml_file(const std::string& file);

}  // namespace gazed::settings
