// The outline of a segmented object, as a few points around it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/object.hpp"

namespace gazed::tracking {

/// The last points where rays from a place on the object leave it, at equal angles all around, in
/// pixels; accurate to a cell of the mask. A ray that meets nothing of the object has no point.
struct Outline {
  static constexpr std::size_t points_max = 64;

  std::array<Eigen::Vector2f, points_max> points_px;
  std::size_t count = 0;
};

/// `inside` is a place on the object, which extends at most `radius_px` from it.
[[nodiscard]] Outline outline_of(const ObjectMask& object, const geometry::Pixel& inside,
                                 double radius_px);

}  // namespace gazed::tracking
