// How sure a camera is that was fitted to pictures of a board.
//
// The inverse of the information matrix takes every corner's error for its own. The corners of one
// picture err together as well: the board is not flat, the lens is not quite the model's, each
// corner is drawn the same way by what is around it. That shows in how the pictures disagree.
#pragma once

#include <span>

#include "agent/lab/calibration/board_fit.hpp"

namespace gazed::lab::calibration {

/// What one picture tells of the camera, its board's pose eliminated, in the units of the camera's
/// numbers: the information matrix, and the gradient at the fit, where all pictures' and the
/// prior's add up to 0.
struct PictureInformation {
  CameraMatrix information = CameraMatrix::Zero();
  CameraNumbers gradient = CameraNumbers::Zero();
};

/// By how much more than their information allows the pictures disagree about the camera, as a
/// factor of sigma: 1 where corners err independently, or where nothing tells. The root of
/// Pearson's chi2 per degree of freedom (McCullagh and Nelder, Generalized Linear Models,
/// 1989, 4.5).
[[nodiscard]] double disagreement(std::span<const PictureInformation> pictures,
                                  const CameraNumbers& prior_sigma);

/// Standard deviations of the camera's numbers. Of each the larger of two: the information's, times
/// the disagreement; and the jackknife's, by how much the number changes where one picture is left
/// out (Efron and Stein, Annals of Statistics 9, 1981: too large rather than too small).
[[nodiscard]] CameraNumbers camera_sigma(std::span<const PictureInformation> pictures,
                                         const CameraNumbers& prior_sigma);

}  // namespace gazed::lab::calibration
