// A chessboard's corners from picture files: which pictures can be used, and why the others cannot.
#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/lab/calibration/chessboard.hpp"

namespace gazed::lab::calibration {

struct BoardPictures {
  std::vector<std::vector<geometry::Pixel>> corners;
  std::vector<std::string> names;   // of those with corners
  cv::Size size;                    // that of most pictures
  std::vector<std::string> unused;  // "FILE: why"
};

/// The pixels are taken as they were coded: an orientation that a camera noted is how it was held,
/// not how its lens sits. Files that cannot be read, pictures of another size than most, and those
/// without all corners are not used. Throws std::runtime_error when none of the files is a picture,
/// std::invalid_argument when no picture shows the board, with the size that they show.
[[nodiscard]] BoardPictures read_board_pictures(const std::vector<std::string>& files,
                                                const Chessboard& board, int window_px);

}  // namespace gazed::lab::calibration
