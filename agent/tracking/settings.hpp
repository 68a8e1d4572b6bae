// What the registration of a patch is told.
#pragma once

namespace gazed::tracking {

struct RegistrationSettings {
  double range_min_m = 0.1;      // the search runs from here
  double range_max_m = 10.0;     // to here
  double correlation_min = 0.8;  // normalised cross-correlation below which the match is refused
};

}  // namespace gazed::tracking
