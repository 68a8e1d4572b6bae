// Recorded data, which is not part of the project: tests of it are skipped where it is absent.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace gazed::triangulation {

/// The folder of one data set beside the project; its README says where it comes from.
inline std::filesystem::path real_data(const std::string& name) {
  return std::filesystem::path(GAZED_SHARED) / "data" / name;
}

/// For GTEST_SKIP.
inline std::string absent(const std::filesystem::path& folder) {
  return "no recorded data in " + folder.string();
}

inline std::ifstream open_data(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot open " + file.string());
  return stream;
}

}  // namespace gazed::triangulation
