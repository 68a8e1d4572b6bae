// The calibration of a camera in a head: from what was seen at many head angles to the geometry,
// with how sure each number is.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "agent/geometry/robot.hpp"
#include "agent/lab/calibration/bundle.hpp"
#include "agent/lab/calibration/chessboard.hpp"
#include "agent/lab/calibration/head_pictures.hpp"
#include "agent/lab/calibration/marks_csv.hpp"
#include "agent/lab/calibration/observability.hpp"

namespace gazed::lab::calibration {

/// What is believed before any picture.
struct HeadBelief {
  HeadModel model;
  geometry::Uncertainty uncertainty;
  bool axis_offset_estimated = false;  // else the axis offset of the model is held
  bool marks_in_torso = false;  // marks are measured in the torso frame, not in one of theirs
};

struct HeadCalibration {
  HeadModel before, after;
  BundleResult fit;
  Certainty certainty;
  Prior prior;
  /// Estimated beside everything else. Held at 1 for `after`, as gazed takes it, unless it is
  /// wrong.
  Eigen::Vector2d encoder_scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d encoder_scale_sigma = Eigen::Vector2d::Zero();
  std::array<bool, 2> scale_is_wrong{};
  std::optional<Eigen::Vector3d> neck_in_pattern_m;  // in the frame of the board or the marks
  std::string input;                                 // "30 pictures of a board, 54 corners each"
  std::size_t sightings = 0;                         // image points in all
  std::vector<std::string> unused;                   // pictures without the board, and why
};

/// The standard deviations that the belief gives each parameter. The mount's rotation is left to
/// the pictures: heads are known whose camera is 4 degrees off. So is its offset, where they are
/// `metric`, of a board or of marks.
[[nodiscard]] Prior prior_of(const HeadBelief& belief, bool metric);

/// Each throws std::invalid_argument for too little to go by, std::runtime_error when no geometry
/// fits.
[[nodiscard]] HeadCalibration calibrate_on_board(const HeadBelief& belief, const Chessboard& board,
                                                 std::span<const HeadPicture> pictures,
                                                 int corner_window_px = window_by_square);
[[nodiscard]] HeadCalibration calibrate_on_scene(const HeadBelief& belief,
                                                 std::span<const HeadPicture> pictures);
[[nodiscard]] HeadCalibration calibrate_on_marks(const HeadBelief& belief,
                                                 std::span<const MarkReading> readings);

}  // namespace gazed::lab::calibration
