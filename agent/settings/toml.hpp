// The configuration as a TOML file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "agent/settings/table.hpp"

namespace gazed::settings {

using IsWanted = bool (*)(std::string_view path);

/// The entries of a text, in its order; `name` is what errors call it. Keys that are not wanted
/// are left out, and what they are set to is nobody's business. Throws SettingsError: longer than
/// 64 KiB, not TOML, or with all unknown keys and all values that are not allowed.
[[nodiscard]] std::vector<Entry> read_toml(std::string_view text, const std::string& name,
                                           IsWanted is_wanted = nullptr);

/// The same of a file. Throws SettingsError also when it cannot be read.
[[nodiscard]] std::vector<Entry> read_toml_file(const std::string& file);

}  // namespace gazed::settings
