// The frames of an LCM log: bot_core.image_t on PREFIX_IMAGE, as `gazed --record`, `gazelab log` or
// lcm-logger wrote them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/camera.hpp"
#include "drivers/lcm/channels.hpp"
#include "drivers/lcm/intake.hpp"
#include "drivers/log/playback.hpp"

namespace gazed::log {

/// Garbage between events, events of other channels, messages that cannot be used and times that go
/// backwards are passed over, and told in notes().
class LogCamera : public drivers::CameraDriver {
 public:
  /// Throws std::invalid_argument when there is no frame of this size to play, with the reason.
  LogCamera(const std::string& path, const lcm::Channels& channels, int width_px, int height_px);

  [[nodiscard]] std::optional<std::int64_t> next_utime_us() override;
  [[nodiscard]] std::optional<geometry::Frame> next_frame() override;
  /// Dropped: gaps in the times.
  [[nodiscard]] drivers::Health health() const override;
  [[nodiscard]] std::string notes() const override { return playback_.notes(); }
  [[nodiscard]] bool finished() const override { return playback_.finished(); }

 private:
  Playback<lcm::FrameIntake> playback_;
};

}  // namespace gazed::log
