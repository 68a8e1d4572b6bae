// A view: one image with the head angles measured at its capture.
#pragma once

#include <cstdint>

#include "agent/geometry/head.hpp"
#include "agent/image.hpp"

namespace gazed {

struct View {
  ImageView image;
  HeadAngles head;            // measured, interpolated to utime_us
  std::int64_t utime_us = 0;  // start of exposure, microseconds since the Unix epoch
};

}  // namespace gazed
