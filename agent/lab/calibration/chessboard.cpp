#include "agent/lab/calibration/chessboard.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "agent/base/text.hpp"
#include "agent/lab/io/csv.hpp"

namespace gazed::lab::calibration {

namespace {

constexpr int fewest_corners = 3, most_corners = 50;
constexpr double smallest_square_m = 0.001, largest_square_m = 1.0;

/// Less than half the least distance between neighbours in a row: no other corner is in it.
int window_of(const std::vector<cv::Point2f>& corners, int columns) {
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i % static_cast<std::size_t>(columns) == 0) continue;
    least = std::min(least, cv::norm(corners[i] - corners[i - 1]));
  }
  constexpr double part_of_square = 0.4;
  return static_cast<int>(
      std::clamp(part_of_square * least, 2.0, 1.0 * largest_window_by_square_px));
}

}  // namespace

Chessboard parsed_chessboard(std::string_view size, double square_m) {
  const std::size_t cross = size.find('x');
  const auto columns = io::parsed<int>(size.substr(0, cross));
  const auto rows =
      cross == std::string_view::npos ? std::nullopt : io::parsed<int>(size.substr(cross + 1));
  const auto fits = [](int count) { return count >= fewest_corners && count <= most_corners; };
  if (!columns || !rows || !fits(*columns) || !fits(*rows)) {
    throw std::invalid_argument("--board: '" + std::string(size) +
                                "' found; allowed: COLUMNSxROWS of inner corners, " +
                                base::text("%d to %d each, as 9x6", fewest_corners, most_corners));
  }
  if (!(square_m >= smallest_square_m && square_m <= largest_square_m)) {
    const std::string found = square_m == 0.0 ? "nothing" : base::text("%g", square_m);
    throw std::invalid_argument(
        base::text("--square: %s found; allowed: the side of a square in metres, %g to %g",
                   found.c_str(), smallest_square_m, largest_square_m));
  }
  return {*columns, *rows, square_m};
}

std::vector<Eigen::Vector3d> corner_places(const Chessboard& board) {
  std::vector<Eigen::Vector3d> places;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      places.emplace_back(board.square_m * column, board.square_m * row, 0.0);
    }
  }
  return places;
}

std::vector<geometry::Pixel> find_corners(const cv::Mat& grey, const Chessboard& board,
                                          int window_px) {
  std::vector<cv::Point2f> corners;
  const bool found = cv::findChessboardCorners(
      grey, {board.columns, board.rows}, corners,
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK);
  if (!found) return {};
  const int half = window_px > 0 ? window_px : window_of(corners, board.columns);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 0.001});
  std::vector<geometry::Pixel> pixels;
  for (const cv::Point2f& corner : corners) pixels.emplace_back(corner.x, corner.y);
  return pixels;
}

std::optional<std::pair<int, int>> size_of_board(const cv::Mat& grey) {
  cv::Mat corners, meta;  // meta: a number for each corner of the board, as it lies
  const bool found =
      cv::findChessboardCornersSB(grey, {fewest_corners, fewest_corners}, corners,
                                  cv::CALIB_CB_LARGER | cv::CALIB_CB_NORMALIZE_IMAGE, meta);
  if (!found || meta.empty()) return std::nullopt;
  return std::pair(std::max(meta.cols, meta.rows), std::min(meta.cols, meta.rows));
}

}  // namespace gazed::lab::calibration
