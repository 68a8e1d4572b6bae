// What gazelab writes beside its tables, and the checks that no input is lost by it.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "agent/saliency/saliency.hpp"

namespace gazed::lab::io {

/// Throws std::invalid_argument when writing `file` would overwrite one of `inputs`.
void check_output_file(const std::filesystem::path& file, std::span<const std::string> inputs);

/// Where each input has an output file of its own.
class OutputFolder {
 public:
  /// `extension` with its dot; an empty `folder`: nothing is written. Throws std::invalid_argument
  /// when two inputs would have the same output file or an input would be overwritten.
  OutputFolder(std::filesystem::path folder, std::string extension,
               std::span<const std::string> inputs);

  [[nodiscard]] bool is_wanted() const { return !folder_.empty(); }
  /// FOLDER/STEM.EXTENSION for an input .../STEM.whatever; of inputs from several folders
  /// FOLDER/NAME/STEM.EXTENSION for .../NAME/STEM.whatever.
  [[nodiscard]] std::filesystem::path file_for(const std::filesystem::path& input) const;
  /// Makes it, and the folders inside. Throws std::invalid_argument.
  void make(std::span<const std::string> inputs) const;

 private:
  std::filesystem::path folder_;
  std::string extension_;
  bool by_folder_;  // the inputs are of several
};

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
