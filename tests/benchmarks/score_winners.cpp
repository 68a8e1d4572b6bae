// Scores the winners that gazelab saliency found: reads its CSV from standard input.
//
//   score_winners mask FOLDER   how many lie inside the object; FOLDER has a PNG of each picture's
//                               stem, above 127 on the object
//   score_winners border        how many lie within 24 px of the border, in the frame whose longer
//                               side is 640
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "agent/lab/io/csv.hpp"
#include "agent/lab/io/picture.hpp"

#include "tests/benchmarks/winners.hpp"

namespace {

namespace fs = std::filesystem;

struct Winner {
  fs::path image;
  gazed::geometry::Pixel pixel;
};

std::vector<Winner> read_winners(std::istream& stream) {
  std::vector<Winner> winners;
  std::string line;
  std::getline(stream, line);
  if (line != "image,x_px,y_px,saliency,distinctness,distinct") {
    throw std::runtime_error("standard input is not the CSV of gazelab saliency: '" + line + "'");
  }
  while (std::getline(stream, line)) {
    const auto fields = gazed::lab::io::split_csv_line(line);
    if (!fields || fields->size() != 6) throw std::runtime_error("not a row: '" + line + "'");
    winners.push_back({(*fields)[0], {std::stod((*fields)[1]), std::stod((*fields)[2])}});
  }
  if (winners.empty()) throw std::runtime_error("no pictures");
  return winners;
}

void print_share(std::size_t count, std::size_t total) {
  std::printf("%zu of %zu (%.1f %%)", count, total,
              100.0 * static_cast<double>(count) / static_cast<double>(total));
}

void score_masks(const std::vector<Winner>& winners, const fs::path& folder) {
  std::size_t hits = 0;
  double area = 0.0;
  for (const Winner& winner : winners) {
    const cv::Mat mask = gazed::benchmarks::mask_of(winner.image, folder);
    hits += gazed::benchmarks::inside_mask(winner.pixel, mask) ? 1 : 0;
    area += cv::mean(mask > 127)[0] / 255.0;
  }
  print_share(hits, winners.size());
  std::printf(", by chance %.1f %%\n", 100.0 * area / static_cast<double>(winners.size()));
}

void score_border(const std::vector<Winner>& winners) {
  std::size_t hits = 0;
  for (const Winner& winner : winners) {
    const cv::Mat picture = gazed::lab::io::read_picture(winner.image);
    hits += gazed::benchmarks::near_border(winner.pixel, picture) ? 1 : 0;
  }
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
