// A frame is an image with its time; a view is an image with the head angles measured at its
// capture.
#pragma once

#include <cstdint>

#include "agent/base/image.hpp"
#include "agent/geometry/head.hpp"

namespace gazed::geometry {

struct Frame {
  base::ImageView image;      // valid until the next call of whoever gave it
  std::int64_t utime_us = 0;  // start of exposure, microseconds since the Unix epoch
};

/// A rolling shutter exposes one row after the other, so that every row has angles of its own. They
/// are taken to change evenly within a frame, which is read out in three or four samples of the
/// joints.
struct View {
  base::ImageView image;
  HeadAngles head;               // measured, interpolated to the exposure of the middle row
  std::int64_t utime_us = 0;     // start of exposure, microseconds since the Unix epoch
  HeadAngles sweep{};            // from the first row to the last; none for a global shutter
  double sweep_sigma_rad = 0.0;  // of each of its components

  /// When row `y` was exposed.
  [[nodiscard]] HeadAngles head_at_row(double y) const {
    const double share = y / (image.height_px - 1) - 0.5;
    return head + HeadAngles{share * sweep.yaw_rad, share * sweep.pitch_rad};
  }
};

}  // namespace gazed::geometry
