// Focal length, principal point and distortion of a camera from pictures of a chessboard that was
// held in many poses (Zhang 2000).
#pragma once

#include <opencv2/core/types.hpp>
#include <span>
#include <string>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/lab/calibration/board_pictures.hpp"
#include "agent/lab/calibration/chessboard.hpp"

namespace gazed::lab::calibration {

struct Intrinsics {
  geometry::CameraModel camera;
  geometry::CameraModel sigma;     // standard deviations, in the members of a camera
  double rms_px = 0.0;             // of the corners' distances
  std::vector<std::string> names;  // of the pictures used
  std::vector<double> picture_rms_px;
  std::vector<std::string> unused;  // "FILE: why"
  int corners_left_out = 0;         // of those pictures
  double covered = 0.0;             // share of the image that the boards' outline covers together
};

constexpr std::size_t fewest_boards = 3;  // a pose gives two equations for five unknowns

/// Pictures that fit far worse than most are left out, and views that are there twice count once.
/// Throws std::invalid_argument for fewer than fewest_boards, for fewer corners than unknowns, and
/// when the poses do not tell the focal length, as where all boards are parallel to the image.
[[nodiscard]] Intrinsics calibrated_intrinsics(const Chessboard& board, BoardPictures pictures);

/// Whether the standard deviation of the focal length is more than gazed should be left alone with.
[[nodiscard]] bool focal_length_is_vague(const Intrinsics& intrinsics);

}  // namespace gazed::lab::calibration
