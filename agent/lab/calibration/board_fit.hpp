// A camera and the poses of a chessboard before it, fitted to the board's corners in all pictures.
//
// Camera numbers: fx, fy, cx, cy, px, then k1, k2, p1, p2, k3, as OpenCV has them.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

namespace gazed::lab::calibration {

constexpr int camera_number_count = 9;
using CameraNumbers = Eigen::Matrix<double, camera_number_count, 1>;
using CameraMatrix = Eigen::Matrix<double, camera_number_count, camera_number_count>;

/// What is known of any camera before a picture is looked at: standard deviations, wide.
struct CameraPrior {
  CameraNumbers mean = CameraNumbers::Zero();
  CameraNumbers sigma = CameraNumbers::Ones();
};
[[nodiscard]] CameraPrior prior_of_any_camera(cv::Size image);

struct BoardFit {
  CameraNumbers camera = CameraNumbers::Zero();
  CameraNumbers sigma = CameraNumbers::Zero();  // standard deviations, with the prior
  double rms_px = 0.0;                          // of all corners' distances
  double noise_px = 0.0;                        // of a coordinate of the corners that were used
  std::vector<double> picture_rms_px;
  int corners_left_out = 0;  // far from where the others put them
};

/// The board's `places` (m, z = 0) in each picture's `pixels`, one for each place. Corners that do
/// not fit lose their weight (Cauchy's loss), then their say. Levenberg and Marquardt's method; the
/// sigmas follow from the information with the poses eliminated, the variance of the residuals per
/// degree of freedom, and how the pictures disagree (board_certainty).
[[nodiscard]] BoardFit fit_boards(const std::vector<cv::Point3f>& places,
                                  std::span<const std::vector<cv::Point2f>> pixels, cv::Size image);

}  // namespace gazed::lab::calibration
