#include "agent/lab/io/output_files.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace gazed::lab::io {

namespace {

namespace fs = std::filesystem;

fs::path parent_of(const fs::path& input) {
  return fs::absolute(input).lexically_normal().parent_path();
}

void write_file(const std::filesystem::path& file, const std::string& header, const char* bytes,
                std::size_t count) {
  std::ofstream stream(file, std::ios::binary);
  stream << header;
  stream.write(bytes, static_cast<std::streamsize>(count));
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

void check_output_file(const fs::path& file, std::span<const std::string> inputs) {
  if (!fs::exists(file)) return;
  std::error_code missing;  // an input that does not exist is not overwritten
  for (const std::string& input : inputs) {
    if (fs::equivalent(file, input, missing)) {
      throw std::invalid_argument("writing " + file.string() + " would overwrite the input " +
                                  input);
    }
  }
}

OutputFolder::OutputFolder(fs::path folder, std::string extension,
                           std::span<const std::string> inputs)
    : folder_(std::move(folder)),
      extension_(std::move(extension)),
      by_folder_(std::ranges::any_of(inputs, [&inputs](const std::string& input) {
        return parent_of(input) != parent_of(inputs.front());
      })) {
  if (!is_wanted()) return;
  std::map<fs::path, std::string> inputs_by_output;
  for (const std::string& input : inputs) {
    const fs::path output = file_for(input);
    const auto [earlier, is_new] = inputs_by_output.emplace(output, input);
    if (!is_new) {
      throw std::invalid_argument(earlier->second + " and " + input + " would both be written to " +
                                  output.string());
    }
    check_output_file(output, inputs);
  }
}

fs::path OutputFolder::file_for(const fs::path& input) const {
  const fs::path folder = by_folder_ ? folder_ / parent_of(input).filename() : folder_;
  return folder / (input.stem().string() + extension_);
}

void OutputFolder::make(std::span<const std::string> inputs) const {
  if (!is_wanted()) return;
  make_folder(folder_);
  for (const std::string& input : inputs) make_folder(file_for(input).parent_path());
}

void make_folder(const fs::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw std::invalid_argument(folder.string() + ": cannot be made a folder: " +
                                (error ? error.message() : "it is a file"));
  }
}

void write_map(const std::filesystem::path& file, const saliency::SaliencyMap& map) {
  constexpr std::uint32_t full_scale = 65535;
  const std::uint32_t peak =
      std::max<std::uint32_t>(1, map.samples.empty() ? 0 : std::ranges::max(map.samples));
  std::string bytes;
  bytes.reserve(2 * map.samples.size());
  for (const std::uint32_t sample : map.samples) {
    const std::uint32_t value = (sample * full_scale + peak / 2) / peak;
    bytes += static_cast<char>(value >> 8);
    bytes += static_cast<char>(value & 0xFF);
  }
  const std::string header = "P5\n" + std::to_string(map.width) + " " + std::to_string(map.height) +
                             "\n" + std::to_string(full_scale) + "\n";
  write_file(file, header, bytes.data(), bytes.size());
}

void write_text_file(const std::filesystem::path& file, const std::string& text) {
  write_file(file, {}, text.data(), text.size());
}

void write_png(const std::filesystem::path& file, const cv::Mat& bgr) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", bgr, bytes)) {
    throw std::runtime_error(file.string() + ": cannot be encoded as PNG");
  }
  const std::string encoded(bytes.begin(), bytes.end());
  write_file(file, {}, encoded.data(), encoded.size());
}

}  // namespace gazed::lab::io
