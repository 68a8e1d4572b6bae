// A folder that goes away, files in it, and runs of the real gazelab.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace gazed::lab {

/// A new empty folder, removed with all it holds at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return folder_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

struct Surroundings {
  std::filesystem::path standard_input = "/dev/null";
  std::string path;  // PATH; empty: as it is
};

/// Runs build/<preset>/bin/gazelab with `arguments`, both outputs to files.
[[nodiscard]] Outcome run_gazelab(const std::vector<std::string>& arguments,
                                  const Surroundings& surroundings = {});

[[nodiscard]] std::string file_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
/// The first `bytes` of a file into another.
void write_cut(const std::filesystem::path& whole, const std::filesystem::path& cut,
               std::size_t bytes);

/// A red disc on a grey wall with a soft edge, 8UC3. Pixel (0,0) is the centre of the top left
/// pixel.
[[nodiscard]] cv::Mat red_disc(cv::Size size, cv::Point2d centre_px, double radius_px);

}  // namespace gazed::lab
