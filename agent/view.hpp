// A frame is an image with its time; a view is an image with the head angles measured at its
// capture.
#pragma once

#include <cstdint>

#include "agent/geometry/head.hpp"
#include "agent/image.hpp"

namespace gazed {

struct Frame {
  ImageView image;            // valid until the next call of whoever gave it
  std::int64_t utime_us = 0;  // start of exposure, microseconds since the Unix epoch
};

struct View {
  ImageView image;
  HeadAngles head;            // measured, interpolated to utime_us
  std::int64_t utime_us = 0;  // start of exposure, microseconds since the Unix epoch
};

}  // namespace gazed
