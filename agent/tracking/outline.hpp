// The outline of a segmented object, as a few points around it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "agent/geometry/camera.hpp"
#include "agent/tracking/object.hpp"

namespace gazed::tracking {

/// Where rays from a place on the object leave it for the last time, by even angles around once,
/// pixels: to a cell of the mask. A ray along which nothing of the object lies has no point.
struct Outline {
  static constexpr std::size_t points_max = 64;

  std::array<Eigen::Vector2f, points_max> points_px;
  std::size_t count = 0;
};

/// `inside` is a place on the object; the object reaches no further than `radius_px` from it.
[[nodiscard]] Outline outline_of(const ObjectMask& object, const geometry::Pixel& inside,
                                 double radius_px);

}  // namespace gazed::tracking
