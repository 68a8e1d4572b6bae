// What the loop asks of any camera.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/geometry/view.hpp"

namespace gazed::drivers {

/// No call blocks, and none throws once the driver is made: what goes wrong shows in fault().
class CameraDriver {
 public:
  virtual ~CameraDriver() = default;

  /// Readable when a frame may have come; -1 for a driver that knows its next_utime_us() instead.
  [[nodiscard]] virtual int descriptor() const { return -1; }
  /// For a simulated or recorded camera, when its next frame is due; none for a live one and after
  /// the last frame.
  [[nodiscard]] virtual std::optional<std::int64_t> next_utime_us() { return std::nullopt; }
  /// The newest frame not yet returned; older ones are dropped and counted by a live driver. A
  /// simulated or recorded one returns its frames one by one.
  [[nodiscard]] virtual std::optional<geometry::Frame> next_frame() = 0;

  /// Lost or dropped frames so far.
  [[nodiscard]] virtual std::int32_t frames_dropped() const { return 0; }
  /// Why no frames come, in words; empty when all is well.
  [[nodiscard]] virtual std::string fault() const { return {}; }
  /// What was passed over so far (a damaged recording), in words; empty when nothing was.
  [[nodiscard]] virtual std::string notes() const { return {}; }
  /// A message for the person who runs gazed, once; empty when there is nothing new.
  [[nodiscard]] virtual std::string warning() { return {}; }
  /// True when no frame will ever come again (a log or a scene at its end).
  [[nodiscard]] virtual bool finished() const { return false; }
};

}  // namespace gazed::drivers
