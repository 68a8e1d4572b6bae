// What the registration of a patch is told.
#pragma once

#include "agent/geometry/camera.hpp"

namespace gazed::tracking {

struct RegistrationSettings {
  double range_min_m = 0.1;      // the search runs from here
  double range_max_m = 10.0;     // to here
  double correlation_min = 0.8;  // normalised cross-correlation below which the match is refused
};

/// Throws std::invalid_argument, with what was found, for settings out of range, a focal length
/// that is not positive or images under 64 px.
void check(const RegistrationSettings& settings, const geometry::CameraModel& camera);

}  // namespace gazed::tracking
