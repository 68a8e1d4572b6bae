// Frames from binary PPM files.
#pragma once

#include <filesystem>

#include "agent/base/image.hpp"

namespace gazed::benchmarks {

/// The picture in a binary PPM file (P6 with a greatest value of 255) as rgb24. Throws
/// std::runtime_error that names the file and says what was found there.
[[nodiscard]] base::Image read_ppm(const std::filesystem::path& file);

}  // namespace gazed::benchmarks
