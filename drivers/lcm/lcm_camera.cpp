#include "drivers/lcm/lcm_camera.hpp"

namespace gazed::lcm {

namespace {

// Two frames on their way and two that wait: with more, old frames would hold back the newest.
constexpr int queue_capacity = 4;

}  // namespace

LcmCamera::LcmCamera(LcmLink& link, const Channels& channels, int width_px, int height_px)
    : link_(link), intake_(channels.image, width_px, height_px) {
  link_.subscribe(
      channels.image, [this](auto message) { intake_.take(message); }, queue_capacity);
}

std::optional<geometry::Frame> LcmCamera::next_frame() {
  link_.handle();
  return intake_.next_frame();
}

std::string LcmCamera::fault() const {
  if (!link_.connected()) return link_.fault();
  return intake_.refusals().last_was_refused() ? intake_.refusals().text() : std::string();
}

}  // namespace gazed::lcm
