// The picture files of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gazed::lab::io {

/// Whether a file is a picture by its ending: JPEG, PNG, PPM, PGM, BMP, TIFF, WebP, JPEG 2000.
[[nodiscard]] bool is_picture_name(const std::filesystem::path& file);

/// The files of `folder`, not of those inside it, that are pictures, by name.
[[nodiscard]] std::vector<std::string> pictures_in(const std::filesystem::path& folder);

}  // namespace gazed::lab::io
