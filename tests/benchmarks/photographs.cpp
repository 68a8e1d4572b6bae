#include "tests/benchmarks/photographs.hpp"

#include <algorithm>
#include <stdexcept>

#include "agent/lab/io/picture.hpp"

namespace gazed::benchmarks {

namespace fs = std::filesystem;

std::vector<fs::path> pictures(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + ": no such folder");
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".jpg") found.push_back(entry.path());
  if (found.empty()) throw std::runtime_error(folder.string() + ": no .jpg in it");
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<fs::path> pictures_of(const fs::path& data, const std::vector<std::string>& folders) {
  std::vector<fs::path> found;
  for (const std::string& folder : folders) {
    if (!fs::is_directory(data / folder)) continue;
    const std::vector<fs::path> more = pictures(data / folder);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

Picture::Picture(const fs::path& file) : Picture(lab::io::read_picture(file)) {}

Picture::Picture(const cv::Mat& bgr)
    : original(bgr),
      frame(lab::io::rgb_of(lab::io::scaled(original, lab::io::working_scale(original)))),
      scale(lab::io::working_scale(original)) {}

geometry::Pixel Picture::winner(const saliency::SaliencySettings& settings) const {
  saliency::Saliency stage(settings, frame.cols, frame.rows);
  return lab::io::input_pixel(stage.examine(lab::io::view_of(frame)).peak_px, scale);
}

}  // namespace gazed::benchmarks
