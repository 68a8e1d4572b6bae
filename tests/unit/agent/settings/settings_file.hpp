// A configuration file for one test.
#pragma once

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <string_view>
#include <system_error>

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
inline std::string whole_refusal_of(const SettingsLayers& layers, const SettingsFile& file) {
  try {
    static_cast<void>(load_settings(layers, nothing_stated));
  } catch (const SettingsError& error) {
    std::string message = error.what();
    const std::string folder = file.folder() + '/';
    for (std::size_t at = 0; (at = message.find(folder, at)) != std::string::npos;)
      message.erase(at, folder.size());
    return message;
  }
  return "accepted";
}

inline std::string whole_refusal_of(std::string_view text) {
  const SettingsFile file(text);
  return whole_refusal_of(file.layers(), file);
}

/// Its first line. When that names a line of the file, this line has to follow, with a caret.
inline std::string refusal_of(const SettingsLayers& layers, const SettingsFile& file) {
  const std::string message = whole_refusal_of(layers, file);
  constexpr std::string_view place = "robot.toml:";
  const bool names_line = message.starts_with(place) && message[place.size()] != ' ';
  EXPECT_EQ(message.find(" | ") != std::string::npos, names_line) << message;
  EXPECT_EQ(message.find('^') != std::string::npos, names_line) << message;
  return message.substr(0, message.find('\n'));
}

inline std::string refusal_of(std::string_view text) {
  const SettingsFile file(text);
  return refusal_of(file.layers(), file);
}

}  // namespace gazed::settings
