#include "tests/benchmarks/winners.hpp"

#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "agent/lab/io/picture.hpp"

namespace gazed::benchmarks {

cv::Mat mask_of(const std::filesystem::path& picture, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / (picture.stem().string() + ".png");
  cv::Mat mask = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (mask.empty()) throw std::runtime_error("cannot read the mask " + file.string());
  return mask;
}

bool inside_mask(const geometry::Pixel& winner_px, const cv::Mat& mask) {
  const auto column = static_cast<int>(std::lround(winner_px.x()));
  const auto row = static_cast<int>(std::lround(winner_px.y()));
  const bool on_picture = column >= 0 && row >= 0 && column < mask.cols && row < mask.rows;
  return on_picture && mask.at<std::uint8_t>(row, column) > 127;
}

bool near_border(const geometry::Pixel& winner_px, const cv::Mat& picture) {
  constexpr double border_px = 24.0;
  const double scale = lab::io::working_scale(picture);
  const geometry::Pixel size(picture.cols, picture.rows);
  const geometry::Pixel from_top_left = (winner_px.array() + 0.5) * scale;
  const geometry::Pixel from_bottom_right = size * scale - from_top_left;
  return from_top_left.minCoeff() < border_px || from_bottom_right.minCoeff() < border_px;
}

}  // namespace gazed::benchmarks
