// Settings of the registration.
#pragma once

#include "agent/geometry/camera.hpp"

namespace gazed::tracking {

struct RegistrationSettings {
  double range_min_m = 0.1;      // nearest range that is searched
  double range_max_m = 10.0;     // farthest range that is searched
  double correlation_min = 0.8;  // a normalised cross-correlation below this is refused
};

/// Throws std::invalid_argument, naming the value, if a setting is out of range, a focal length is
/// not positive, or images are smaller than 64 px.
void check(const RegistrationSettings& settings, const geometry::CameraModel& camera);

}  // namespace gazed::tracking
