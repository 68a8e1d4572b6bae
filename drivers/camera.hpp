// What the loop asks of any camera.
#pragma once

#include <optional>

#include "agent/geometry/view.hpp"
#include "drivers/driver.hpp"

namespace gazed::drivers {

class CameraDriver : public Driver {
 public:
  /// The newest frame not yet returned; older ones are dropped and counted by a live driver. A
  /// scheduled one returns its frames one by one.
  [[nodiscard]] virtual std::optional<geometry::Frame> next_frame() = 0;
};

}  // namespace gazed::drivers
