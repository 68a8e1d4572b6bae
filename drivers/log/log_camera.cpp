#include "drivers/log/log_camera.hpp"

namespace gazed::log {

LogCamera::LogCamera(const std::string& path, const lcm::Channels& channels, int width_px,
                     int height_px)
    : playback_(path, channels.image, lcm::FrameIntake(channels.image, width_px, height_px)) {}

std::optional<std::int64_t> LogCamera::next_utime_us() {
  return playback_.due_us();
}

std::optional<geometry::Frame> LogCamera::next_frame() {
  const std::optional<geometry::Frame> frame = playback_.intake().next_frame();
  if (frame) playback_.advance();
  return frame;
}

drivers::Health LogCamera::health() const {
  drivers::Health health = playback_.health();
  health.dropped = playback_.intake().frames_dropped();
  return health;
}

}  // namespace gazed::log
