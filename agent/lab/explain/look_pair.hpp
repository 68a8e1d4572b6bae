// A later look against look 1, by what is believed of the robot after all looks: where each camera
// sees the other, and the lines on which it sees what the other sees at one pixel.
//
// Epipole: the image of the other camera's centre. Epipolar line: the image of a ray of the other
// camera; it begins at the epipole.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "agent/cycle/fixation.hpp"
#include "agent/geometry/camera.hpp"
#include "agent/geometry/pose.hpp"

namespace gazed::lab::explain {

/// Points along a line, with lens distortion, as far as they are in front of the camera.
using PixelLine = std::vector<Eigen::Vector2d>;

struct LookPair {
  geometry::CameraModel camera;
  geometry::Pose cam_from_cam1;

  /// Where look 1's camera would be seen in the later look, and the later look's in look 1; a
  /// centre behind the camera is where the lines meet all the same. NaN where neither is seen.
  [[nodiscard]] geometry::Pixel epipole_in_later() const;
  [[nodiscard]] geometry::Pixel epipole_in_first() const;
  /// What look 1 sees at a pixel, as the later look may see it, and the other way round: from
  /// infinity to `nearest_m` from the camera whose pixel it is.
  [[nodiscard]] PixelLine line_in_later(const geometry::Pixel& pixel_1, double nearest_m) const;
  [[nodiscard]] PixelLine line_in_first(const geometry::Pixel& pixel, double nearest_m) const;

  [[nodiscard]] double baseline_m() const { return cam_from_cam1.translation.norm(); }
  /// Between the baseline and the ray of a pixel of look 1, 0 to pi/2: at 0 a point on that ray has
  /// no parallax. NaN for a pixel without a ray.
  [[nodiscard]] double angle_to_baseline_rad(const geometry::Pixel& pixel_1) const;
};

/// By the refined angles of both looks or, where one of them has none, the measured ones. `look`
/// counts from 0; none for look 0 and where the angles are no numbers.
[[nodiscard]] std::optional<LookPair> pair_of(const cycle::Fixation& fixation, std::size_t look);

/// How far apart a pair's two epipoles are, each in its own look. NaN where one of them is nowhere.
[[nodiscard]] double epipole_distance_px(const LookPair& pair);

}  // namespace gazed::lab::explain
