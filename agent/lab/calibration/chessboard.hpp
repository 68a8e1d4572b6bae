// The chessboard that a camera is calibrated with, and its corners in a picture.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "agent/geometry/camera.hpp"

namespace gazed::lab::calibration {

struct Chessboard {
  int columns = 0;  // inner corners, where four squares meet
  int rows = 0;
  double square_m = 0.0;

  [[nodiscard]] int corner_count() const { return columns * rows; }
};

/// `size`: "9x6", inner corners. Throws std::invalid_argument that names the values allowed: 3 to
/// 50 of either, a square of 1 mm to 1 m.
[[nodiscard]] Chessboard parsed_chessboard(std::string_view size, double square_m);

/// The corners' places in the board's own frame, z = 0, row by row.
[[nodiscard]] std::vector<Eigen::Vector3d> corner_places(const Chessboard& board);

/// Half the side of the window that refines a corner, px: less than half a square, and no larger
/// than that of OpenCV's calibration sample (11). Where squares are narrower than about 25 px the
/// sample's reaches into the next square, and puts the corner a pixel off.
constexpr int window_by_square = 0;
constexpr int largest_window_by_square_px = 11;

/// The corners in a grey picture (8UC1), to sub-pixel, in the order of corner_places(); empty when
/// not all of the board is found. Which of its two far corners comes first may differ from picture
/// to picture.
[[nodiscard]] std::vector<geometry::Pixel> find_corners(const cv::Mat& grey,
                                                        const Chessboard& board,
                                                        int window_px = window_by_square);

/// Columns and rows of inner corners of the largest chessboard in a picture, columns the more; none
/// when there is no board.
[[nodiscard]] std::optional<std::pair<int, int>> size_of_board(const cv::Mat& grey);

}  // namespace gazed::lab::calibration
