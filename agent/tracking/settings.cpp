#include "agent/tracking/settings.hpp"

#include <algorithm>
#include <stdexcept>

#include "agent/base/text.hpp"

namespace gazed::tracking {

void check(const RegistrationSettings& settings, const geometry::CameraModel& camera) {
  const auto refuse = [](const char* name, double value, const char* allowed) {
    throw std::invalid_argument(base::text("%s is %g, must be %s", name, value, allowed));
  };
  if (!(settings.range_min_m > 0.0)) refuse("range_min_m", settings.range_min_m, "positive");
  if (!(settings.range_max_m > settings.range_min_m)) {
    refuse("range_max_m", settings.range_max_m, "above range_min_m");
  }
  if (!(settings.correlation_min > 0.0 && settings.correlation_min < 1.0)) {
    refuse("correlation_min", settings.correlation_min, "between 0 and 1");
  }
  if (!(camera.focal_px.minCoeff() > 0.0)) {
    refuse("focal_px", camera.focal_px.minCoeff(), "positive");
  }
  if (std::min(camera.width_px, camera.height_px) < 64) {
    refuse("image size", std::min(camera.width_px, camera.height_px), "at least 64 px");
  }
}

}  // namespace gazed::tracking
