// The bytes of a picture file, and whether they are all there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace gazed::lab::io {

/// The file's bytes. Throws std::runtime_error that names the file and the reason of the system.
[[nodiscard]] std::vector<std::uint8_t> read_encoded_picture(const std::filesystem::path& file);

/// True for a JPEG that ends before its last block, its end-of-image marker (ITU T.81 B.2.1) alone
/// may be missing, and a PNG without its IEND chunk (W3C PNG 5.6), wherever they were cut. Of other
/// formats the decoder notices it, so false.
[[nodiscard]] bool ends_early(std::span<const std::uint8_t> bytes);

/// Puts an end-of-image marker behind a JPEG: OpenCV's decoder leaves out the last rows of one that
/// has none. A second marker does no harm.
void end_jpeg(std::vector<std::uint8_t>& bytes);

}  // namespace gazed::lab::io
