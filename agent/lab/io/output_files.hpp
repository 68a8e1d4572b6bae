// What gazelab writes beside its tables, and the checks that no input is lost by it.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "agent/saliency/saliency.hpp"

namespace gazed::lab::io {

/// FOLDER/STEM.EXTENSION for an input .../STEM.whatever; `extension` with its dot.
[[nodiscard]] std::filesystem::path output_file(const std::filesystem::path& folder,
                                                const std::filesystem::path& input,
                                                const std::string& extension);

/// Throws std::invalid_argument when writing `file` would overwrite one of `inputs`.
void check_output_file(const std::filesystem::path& file, std::span<const std::string> inputs);

/// Throws std::invalid_argument when two inputs have the same output_file or an input would be
/// overwritten. Without a folder (empty path) there is nothing to check.
void check_output_folder(const std::filesystem::path& folder, const std::string& extension,
                         std::span<const std::string> inputs);

/// Makes the folder and those above it where they are missing; nothing for an empty path. Throws
/// std::invalid_argument.
void make_folder(const std::filesystem::path& folder);

/// The map as P5 with 16 bit (most significant byte first, Netpbm), its maximum at 65535; a map of
/// zeros stays zero. Throws std::runtime_error that names the file.
void write_map(const std::filesystem::path& file, const saliency::SaliencyMap& map);

/// A text file. Throws std::runtime_error that names the file.
void write_text_file(const std::filesystem::path& file, const std::string& text);

/// A PNG file. Throws std::runtime_error that names the file.
void write_png(const std::filesystem::path& file, const cv::Mat& bgr);

}  // namespace gazed::lab::io
