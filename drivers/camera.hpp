// What the loop asks of any camera.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "agent/geometry/view.hpp"
#include "drivers/driver.hpp"

namespace gazed::drivers {

/// Whether somebody will look at a frame of that time.
using FrameFilter = std::function<bool(std::int64_t utime_us)>;

class CameraDriver : public Driver {
 public:
  /// The newest frame not yet returned; older ones are dropped and counted by a live driver. A
  /// scheduled one returns its frames one by one.
  [[nodiscard]] virtual std::optional<geometry::Frame> next_frame() = 0;
  /// As next_frame(), but a frame that is not wanted may show anything: to draw it is most of a
  /// simulation's time.
  [[nodiscard]] virtual std::optional<geometry::Frame> next_frame_if(const FrameFilter&) {
    return next_frame();
  }
};

}  // namespace gazed::drivers
