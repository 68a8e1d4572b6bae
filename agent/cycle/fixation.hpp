// How one fixation ended: everything that is published of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::cycle {

/// All looks at one target, or the attempt, and what they came to: located or not. A number without
/// a meaning is NaN.
struct Fixation {
  std::int64_t utime_us = 0;  // capture of the last view used
  std::int32_t number = 0;    // from 1
  bool counts = true;         // false for a fault that comes back while nothing is being looked at
  int views = 0;              // views used, looks_max at most
  triangulation::PointEstimate estimate;  // with the status and the reason
  geometry::Pixel pixel_1 = geometry::Pixel::Constant(triangulation::not_a_number);
  geometry::Pixel pixel_2 =
      geometry::Pixel::Constant(triangulation::not_a_number);  // in the last view
  geometry::HeadAngles head_1{triangulation::not_a_number,
                              triangulation::not_a_number};  // measured at capture
  geometry::HeadAngles head_2{triangulation::not_a_number,
                              triangulation::not_a_number};  // of the last view
  float saliency = static_cast<float>(triangulation::not_a_number);
  float distinctness = static_cast<float>(triangulation::not_a_number);
  double duration_s = 0.0;  // from the first frame looked at to the last view's capture
};

}  // namespace gazed::cycle
