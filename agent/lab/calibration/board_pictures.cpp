#include "agent/lab/calibration/board_pictures.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "agent/base/text.hpp"
#include "agent/lab/io/picture.hpp"
#include "agent/lab/io/progress.hpp"

namespace gazed::lab::calibration {

namespace {

struct Searched {
  std::string name;
  cv::Size size;
  std::vector<geometry::Pixel> corners;  // empty: not found
};

cv::Mat read_grey(const std::string& file) {
  cv::Mat grey;
  cv::cvtColor(io::read_picture(file, io::Orientation::as_coded), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

/// The size of most pictures; of two as frequent the one that came first.
cv::Size most_frequent_size(std::span<const Searched> pictures) {
  const auto frequency = [&](const Searched& picture) {
    return std::ranges::count(pictures, picture.size, &Searched::size);
  };
  return std::ranges::max_element(pictures, {}, frequency)->size;
}

/// Of the sizes of board that the pictures show, the first one that two of them show, else the one
/// that most of them show: the search for a board of any size takes seconds a picture.
std::optional<Chessboard> board_shown(std::span<const Searched> pictures) {
  constexpr int agreeing = 2;
  std::map<std::pair<int, int>, int> frequency;
  for (const Searched& picture : pictures) {
    const auto size = size_of_board(read_grey(picture.name));
    if (size && ++frequency[*size] == agreeing) break;
  }
  if (frequency.empty()) return std::nullopt;
  const auto by_count = [](const auto& entry) { return entry.second; };
  const auto [columns, rows] = std::ranges::max_element(frequency, {}, by_count)->first;
  return Chessboard{.columns = columns, .rows = rows};
}

[[noreturn]] void refuse_board(std::span<const Searched> pictures, const Chessboard& board,
                               int window_px) {
  std::string message = base::text("--board %dx%d: not found in any of %zu pictures", board.columns,
                                   board.rows, pictures.size());
  if (const auto shown = board_shown(pictures)) {
    const auto count = std::ranges::count_if(pictures, [&](const Searched& picture) {
      return !find_corners(read_grey(picture.name), *shown, window_px).empty();
    });
    message +=
        base::text("; %dx%d is found in %d: --board counts inner corners, where four squares meet",
                   shown->columns, shown->rows, static_cast<int>(count));
  }
  throw std::invalid_argument(message);
}

}  // namespace

BoardPictures read_board_pictures(const std::vector<std::string>& files, const Chessboard& board,
                                  int window_px) {
  BoardPictures result;
  std::vector<Searched> pictures;
  io::Progress progress(files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    try {
      const cv::Mat grey = read_grey(files[i]);
      pictures.push_back({files[i], grey.size(), find_corners(grey, board, window_px)});
    } catch (const std::runtime_error& error) {
      result.unused.emplace_back(error.what());  // begins with the file
    }
    progress.show(i + 1);
  }
  progress.clear();
  if (pictures.empty()) throw std::runtime_error(result.unused.front());
  result.size = most_frequent_size(pictures);
  for (Searched& picture : pictures) {
    if (picture.size != result.size) {
      result.unused.push_back(base::text("%s: is %dx%d, most are %dx%d", picture.name.c_str(),
                                         picture.size.width, picture.size.height, result.size.width,
                                         result.size.height));
    } else if (picture.corners.empty()) {
      result.unused.push_back(base::text("%s: not all %dx%d inner corners of the board are found",
                                         picture.name.c_str(), board.columns, board.rows));
    } else {
      result.corners.push_back(std::move(picture.corners));
      result.names.push_back(picture.name);
    }
  }
  if (result.corners.empty()) refuse_board(pictures, board, window_px);
  return result;
}

}  // namespace gazed::lab::calibration
