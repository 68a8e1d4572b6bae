// Any bytes as a camera's or a head's message.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <variant>

#include "drivers/lcm/checks.hpp"
#include "drivers/lcm/intake.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gazed;
  const std::span<const std::uint8_t> message(data, size);
  const auto image = lcm::read_image(message);
  const auto* wire = std::get_if<lcm::WireImage>(&image);
  if (wire != nullptr && wire->coding == lcm::Coding::jpeg) {
    if (wire->jpeg.data() < data || wire->jpeg.data() + wire->jpeg.size() > data + size)
      std::abort();
  } else if (wire != nullptr) {
    // Every pixel of a frame that is taken lies in the message.
    const base::ImageView& view = wire->frame.image;
    const std::uint8_t* last = view.row(view.height_px - 1);
    if (view.row(0) < data || last + view.width_px > data + size) std::abort();
  } else if (std::get<lcm::Refusal>(image).reason.empty()) {
    std::abort();
  }
  static_cast<void>(lcm::read_head_state(message));
  static lcm::FrameIntake frames("IMAGE", 32, 16);
  static lcm::HeadStateIntake states("STATE");
  if (frames.take(message) && !frames.next_frame()) std::abort();
  static_cast<void>(states.take(message));
  static_cast<void>(states.next_state());
  return 0;
}
