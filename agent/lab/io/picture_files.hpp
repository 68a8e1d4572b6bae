// The picture files of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gazed::lab::io {

/// The files of `folder`, not of those inside it, that are pictures by their ending (JPEG, PNG,
/// PPM, PGM, BMP, TIFF, WebP, JPEG 2000), by name.
[[nodiscard]] std::vector<std::string> pictures_in(const std::filesystem::path& folder);

}  // namespace gazed::lab::io
