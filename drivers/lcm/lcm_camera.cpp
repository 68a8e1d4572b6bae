#include "drivers/lcm/lcm_camera.hpp"

namespace gazed::lcm {

namespace {

/// What an image_t of this size can have: RGB with rows padded to whatever hardware likes, its
/// numbers, and metadata.
std::size_t image_bytes_max(int width_px, int height_px) {
  constexpr std::size_t row_padding = 512, rest = 65536;
  return (3 * static_cast<std::size_t>(width_px) + row_padding) *
             static_cast<std::size_t>(height_px) +
         rest;
}

}  // namespace

LcmCamera::LcmCamera(LcmLink& link, const Channels& channels, int width_px, int height_px)
    : link_(link), intake_(channels.image, width_px, height_px) {
  link_.subscribe(
      {.channel = channels.image,
       .message_bytes_max = image_bytes_max(width_px, height_px),
       .handler = [this](auto message) { intake_.take(message, clocks_.realtime_us()); },
       .refused = [this](std::size_t bytes) { intake_.refuse_size(bytes); }});
}

std::optional<geometry::Frame> LcmCamera::next_frame() {
  link_.handle();
  return intake_.next_frame();
}

drivers::Health LcmCamera::health() const {
  drivers::Health health{.dropped = intake_.frames_dropped()};
  if (!link_.connected()) {
    health.add(drivers::HealthKind::no_link, link_.fault());
  } else if (intake_.refusals().last_was_refused()) {
    health.add(drivers::HealthKind::refused, intake_.refusals().text());
  }
  return health;
}

}  // namespace gazed::lcm
