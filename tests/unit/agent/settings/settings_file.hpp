// A configuration file for one test.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <string_view>

#include "agent/settings/settings.hpp"

namespace gazed::settings {

/// A folder of its own that goes with the object; `robot.toml` in it.
class SettingsFile {
 public:
  SettingsFile() {
    std::string name = (std::filesystem::temp_directory_path() / "gazed-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  explicit SettingsFile(std::string_view text) : SettingsFile() { write(text); }
  ~SettingsFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  SettingsFile(const SettingsFile&) = delete;
  SettingsFile& operator=(const SettingsFile&) = delete;

  void write(std::string_view text) const { std::ofstream(path(), std::ios::binary) << text; }
  [[nodiscard]] std::string folder() const { return folder_.string(); }
  [[nodiscard]] std::string path() const { return (folder_ / "robot.toml").string(); }
  [[nodiscard]] SettingsLayers layers() const {
    return {.environment = {}, .file = path(), .command_line = {}};
  }

 private:
  std::filesystem::path folder_;
};

inline geometry::UncertaintyOverride nothing_stated(const std::string&) {
  return {};
}

/// What a file with this text gives.
inline Settings load_text(std::string_view text) {
  const SettingsFile file(text);
  return load_settings(file.layers(), nothing_stated);
}

/// The message that refuses these layers, without the folder of `file`; "accepted" when nothing
/// does.
inline std::string refusal_of(const SettingsLayers& layers, const SettingsFile& file) {
  try {
    static_cast<void>(load_settings(layers, nothing_stated));
  } catch (const SettingsError& error) {
    std::string message = error.what();
    const std::string folder = file.folder() + '/';
    if (message.starts_with(folder)) message.erase(0, folder.size());
    return message;
  }
  return "accepted";
}

inline std::string refusal_of(std::string_view text) {
  const SettingsFile file(text);
  return refusal_of(file.layers(), file);
}

}  // namespace gazed::settings
