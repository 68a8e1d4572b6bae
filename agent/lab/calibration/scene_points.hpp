// Points of a textured scene that stands still, found again in the pictures of other head angles.
#pragma once

#include <span>
#include <vector>

#include "agent/lab/calibration/bundle.hpp"
#include "agent/lab/calibration/head_pictures.hpp"

namespace gazed::lab::calibration {

struct ScenePoints {
  std::vector<PointSighting> sightings;  // look = index of the picture
  int point_count = 0;
};

/// Corners of each picture (Shi and Tomasi 1994), followed into the pictures of neighbouring head
/// angles by registration of their surroundings (Lucas and Kanade 1981, in pyramids, there and
/// back). Each picture is first turned by what `model` believes of the head, so that only the
/// model's error and the parallax are left to find: up to about 60 px. A point is kept when at
/// least two other pictures show it.
[[nodiscard]] ScenePoints find_scene_points(std::span<const HeadPicture> pictures,
                                            const HeadModel& model);

}  // namespace gazed::lab::calibration
