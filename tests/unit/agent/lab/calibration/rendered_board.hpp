// Pictures of a chessboard before a known camera.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "agent/geometry/camera.hpp"
#include "agent/lab/calibration/chessboard.hpp"

namespace gazed::lab::calibration {

/// How the board is held: its middle, m, in the camera's frame, and the rotation vector that takes
/// its axes there; at 0 it is parallel to the image.
struct BoardPose {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
};

struct PictureQuality {
  double blur_sigma_px = 0.6;
  double noise = 1.5;  // grey levels
};

class BoardRenderer {
 public:
  BoardRenderer(const geometry::CameraModel& camera, const Chessboard& board,
                PictureQuality quality = {});

  /// 8UC1: dark squares on a light wall, each pixel the mean of what it covers, blurred, with
  /// noise.
  [[nodiscard]] cv::Mat picture(const BoardPose& pose, std::uint64_t seed) const;

 private:
  geometry::CameraModel camera_;
  Chessboard board_;
  PictureQuality quality_;
  std::vector<Eigen::Vector2f> rays_;  // at the plane z = 1, of the parts of all pixels
};

/// 640x480, as a NAO's.
[[nodiscard]] geometry::CameraModel rendered_camera();

/// `count` poses, all in view: tilted by up to `tilt_rad` about any axis across the view, anywhere
/// before the camera.
[[nodiscard]] std::vector<BoardPose> board_poses(int count, double tilt_rad, std::uint64_t seed);

}  // namespace gazed::lab::calibration
