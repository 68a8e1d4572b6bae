// The interface of all cameras.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "agent/geometry/view.hpp"
#include "drivers/driver.hpp"

namespace gazed::drivers {

/// Whether anybody will look at a frame of this time.
using FrameFilter = std::function<bool(std::int64_t utime_us)>;

class CameraDriver : public Driver {
 public:
  /// The newest frame not returned yet. A live driver drops and counts older ones; a scheduled
  /// driver returns every frame.
  [[nodiscard]] virtual std::optional<geometry::Frame> next_frame() = 0;
  /// Like next_frame(), but a frame that is not wanted may show anything: rendering is most of a
  /// simulation's time.
  [[nodiscard]] virtual std::optional<geometry::Frame> next_frame_if(const FrameFilter&) {
    return next_frame();
  }
};

}  // namespace gazed::drivers
