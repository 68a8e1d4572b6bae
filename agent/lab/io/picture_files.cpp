#include "agent/lab/io/picture_files.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace gazed::lab::io {

bool is_picture_name(const std::filesystem::path& file) {
  constexpr auto endings = std::to_array<std::string_view>(
      {".jpg", ".jpeg", ".png", ".ppm", ".pgm", ".pbm", ".bmp", ".tif", ".tiff", ".webp", ".jp2"});
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return std::ranges::find(endings, ending) != endings.end();
}

std::vector<std::string> pictures_in(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_picture_name(entry.path())) {
      files.push_back(entry.path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace gazed::lab::io
