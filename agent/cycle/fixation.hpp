// How one fixation ended: everything that is published of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

#include "agent/geometry/camera.hpp"
#include "agent/geometry/head.hpp"
#include "agent/triangulation/two_view.hpp"

namespace gazed::cycle {

/// How a fixation ended. The numbers are those of located_point_t.
enum class Status : std::int8_t {
  located = 0,
  no_salient_object = 1,
  target_lost = 2,
  degenerate = 3,
  behind_camera = 4,
  uncertain = 5,
  head_fault = 6,
  camera_fault = 7,
};
inline constexpr int status_count = 8;

/// "LOCATED", "NO_SALIENT_OBJECT", ...
[[nodiscard]] std::string_view name(Status status);

/// How a fixation ends that ended in a triangulation. What that calls invalid is, seen from
/// outside, a pixel without a ray: no target there.
[[nodiscard]] Status status_of(triangulation::Status status);

/// All looks at one target, or the attempt, and what they came to: located or not. A number without
/// a meaning is NaN.
struct Fixation {
  std::int64_t utime_us = 0;  // capture of the last view used
  std::int32_t number = 0;    // from 1
  bool counts = true;         // false for a fault that comes back while nothing is being looked at
  int views = 0;              // views used, looks_max at most
  Status status = Status::target_lost;
  std::string reason;                     // in words, with the numbers that decided
  triangulation::PointEstimate estimate;  // its numbers; its own status and reason go no further
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
