// Focal length, principal point and distortion of a camera from pictures of a chessboard that was
// held in many poses (Zhang 2000, as in OpenCV's calib3d).
#pragma once

#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/lab/calibration/chessboard.hpp"

namespace gazed::lab::calibration {

struct Intrinsics {
  geometry::CameraModel camera;
  geometry::CameraModel sigma;  // standard deviations, in the members of a camera
  double rms_px = 0.0;          // of the corners' distances
  std::vector<double> picture_rms_px;
  double covered = 0.0;  // share of the image that the boards' outline covers together
};

constexpr std::size_t fewest_boards = 3;  // a pose gives two equations for five unknowns

/// `corners`: those of each picture, at least fewest_boards of them. Throws std::invalid_argument
/// with fewer, std::runtime_error when the poses do not determine a camera (all of them parallel).
[[nodiscard]] Intrinsics calibrated_intrinsics(
    const Chessboard& board, std::span<const std::vector<geometry::Pixel>> corners, cv::Size image);

}  // namespace gazed::lab::calibration
