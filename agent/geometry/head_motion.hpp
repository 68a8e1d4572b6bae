// What a head says and what it is told.
#pragma once

#include <cstdint>

#include "agent/geometry/head.hpp"

namespace gazed::geometry {

struct HeadState {
  std::int64_t utime_us = 0;  // of the measurement, microseconds since the Unix epoch
  HeadAngles measured;
  HeadAngles velocity_rad_s;  // NaN where the source does not measure it
  float stiffness = 0.0F;
  float temperature_c = 0.0F;
};

struct HeadCommand {
  std::int64_t utime_us = 0;
  HeadAngles target;
  double speed_fraction =
      0.0;  // of each joint's greatest speed, (0, 1]; both joints arrive together
};

}  // namespace gazed::geometry
