// Scores the winners that gazelab saliency found: reads its CSV from standard input.
//
//   score_winners mask FOLDER   how many lie inside the object; FOLDER has a PNG of each picture's
//                               stem, above 127 on the object
//   score_winners border        how many lie within 24 px of the border, in the frame whose longer
//                               side is 640
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/csv.hpp"
#include "agent/lab/picture.hpp"

namespace {

namespace fs = std::filesystem;

struct Winner {
  fs::path image;
  gazed::Pixel pixel;
};

std::vector<Winner> read_winners(std::istream& stream) {
  std::vector<Winner> winners;
  std::string line;
  std::getline(stream, line);
  if (line != "image,x_px,y_px,saliency,distinctness") {
    throw std::runtime_error("standard input is not the CSV of gazelab saliency: '" + line + "'");
  }
  while (std::getline(stream, line)) {
    const auto fields = gazed::split_csv_line(line);
    if (!fields || fields->size() != 5) throw std::runtime_error("not a row: '" + line + "'");
    winners.push_back({(*fields)[0], {std::stod((*fields)[1]), std::stod((*fields)[2])}});
  }
  if (winners.empty()) throw std::runtime_error("no pictures");
  return winners;
}

bool inside_mask(const Winner& winner, const cv::Mat& mask) {
  const auto column = static_cast<int>(std::lround(winner.pixel.x()));
  const auto row = static_cast<int>(std::lround(winner.pixel.y()));
  const bool on_picture = column >= 0 && row >= 0 && column < mask.cols && row < mask.rows;
  return on_picture && mask.at<std::uint8_t>(row, column) > 127;
}

bool near_border(const Winner& winner) {
  constexpr double border_px = 24.0;
  const cv::Mat picture = gazed::read_picture(winner.image);
  const double scale = gazed::working_scale(picture);
  const gazed::Pixel size(picture.cols, picture.rows);
  const gazed::Pixel from_top_left = (winner.pixel.array() + 0.5) * scale;
  const gazed::Pixel from_bottom_right = size * scale - from_top_left;
  return from_top_left.minCoeff() < border_px || from_bottom_right.minCoeff() < border_px;
}

void print_share(std::size_t count, std::size_t total) {
  std::printf("%zu of %zu (%.1f %%)", count, total,
              100.0 * static_cast<double>(count) / static_cast<double>(total));
}

void score_masks(const std::vector<Winner>& winners, const fs::path& folder) {
  std::size_t hits = 0;
  double area = 0.0;
  for (const Winner& winner : winners) {
    const fs::path file = folder / (winner.image.stem().string() + ".png");
    const cv::Mat mask = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    if (mask.empty()) throw std::runtime_error("cannot read the mask " + file.string());
    hits += inside_mask(winner, mask) ? 1 : 0;
    area += cv::mean(mask > 127)[0] / 255.0;
  }
  print_share(hits, winners.size());
  std::printf(", by chance %.1f %%\n", 100.0 * area / static_cast<double>(winners.size()));
}

void score_border(const std::vector<Winner>& winners) {
  std::size_t hits = 0;
  for (const Winner& winner : winners) hits += near_border(winner) ? 1 : 0;
  print_share(hits, winners.size());
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "mask" && argc == 3) {
      score_masks(read_winners(std::cin), argv[2]);
    } else if (what == "border" && argc == 2) {
      score_border(read_winners(std::cin));
    } else {
      std::fprintf(stderr, "usage: score_winners mask FOLDER | border   < CSV\n");
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "score_winners: %s\n", error.what());
    return 1;
  }
  return 0;
}
