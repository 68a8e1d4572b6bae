#include "drivers/lcm/intake.hpp"

#include <utility>
#include <variant>

#include "agent/base/counted.hpp"
#include "agent/base/text.hpp"
#include "drivers/jpeg/decoder.hpp"
#include "drivers/lcm/checks.hpp"
#include "drivers/lcm/conversions.hpp"

namespace gazed::lcm {

void Refusals::add(std::string reason) {
  ++count_;
  last_was_refused_ = true;
  last_reason_ = std::move(reason);
}

std::string Refusals::text() const {
  if (count_ == 0) return {};
  return channel_ + ": " + base::counted(count_, "message") + " refused, the last: " + last_reason_;
}

std::string ArrivalWarning::text(const Refusals& channel, const drivers::RepeatedStamp& stamp) {
  if (!stamp.arrival_counts() || std::exchange(reported_, true)) return {};
  return channel.channel() +
         ": every message has the same utime: they count from when they arrive, and where the head "
         "was then is uncertain";
}

FrameIntake::FrameIntake(std::string channel, int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px), refusals_(std::move(channel)) {
  // The format with the most bytes a pixel: no frame needs more memory later.
  waiting_.reserve(width_px, height_px, base::PixelFormat::rgb24);
  handed_out_.reserve(width_px, height_px, base::PixelFormat::rgb24);
}

bool FrameIntake::take(std::span<const std::uint8_t> message,
                       std::optional<std::int64_t> arrived_us) {
  std::variant<WireImage, Refusal> read = read_image(message);
  auto* image = std::get_if<WireImage>(&read);
  std::string refusal;
  if (image == nullptr) {
    refusal = std::get<Refusal>(read).reason;
  } else {
    geometry::Frame& frame = image->frame;
    frame.utime_us = repeated_stamp_.time_of(frame.utime_us, arrived_us);
    if (frame.image.width_px != width_px_ || frame.image.height_px != height_px_) {
      refusal = "an image of " + base::size_text(frame.image.width_px, frame.image.height_px) +
                " pixels where " + base::size_text(width_px_, height_px_) + " is configured";
    } else {
      refusal = utime_check_.refusal(frame.utime_us);
    }
    if (refusal.empty()) refusal = keep(*image);
  }
  if (!refusal.empty()) {
    refusals_.add(std::move(refusal));
    return false;
  }
  refusals_.accepted();
  gaps_.saw(image->frame.utime_us);
  waiting_utime_us_ = image->frame.utime_us;
  if (std::exchange(is_waiting_, true)) ++replaced_;
  return true;
}

std::string FrameIntake::keep(const WireImage& image) {
  const base::ImageView& pixels = image.frame.image;
  if (image.coding == Coding::jpeg) {
    std::string problem = jpeg::decode(image.jpeg, width_px_, height_px_, decoded_);
    if (problem.empty()) std::swap(waiting_, decoded_);
    return problem;
  }
  waiting_.assign(pixels);
  if (image.coding == Coding::swapped) swap_bytes(waiting_.pixels(), pixels.format);
  return {};
}

void FrameIntake::refuse_size(std::size_t message_bytes) {
  refusals_.add("a message of " + std::to_string(message_bytes) +
                " bytes, more than any image of the configured " +
                base::size_text(width_px_, height_px_) + " pixels has");
}

std::optional<std::int64_t> FrameIntake::waiting_utime_us() const {
  if (!is_waiting_) return std::nullopt;
  return waiting_utime_us_;
}

std::optional<geometry::Frame> FrameIntake::next_frame() {
  if (!std::exchange(is_waiting_, false)) return std::nullopt;
  std::swap(waiting_, handed_out_);
  return geometry::Frame{.image = handed_out_.view(), .utime_us = waiting_utime_us_};
}

bool HeadStateIntake::take(std::span<const std::uint8_t> message,
                           std::optional<std::int64_t> arrived_us) {
  std::variant<geometry::HeadState, Refusal> read = read_head_state(message);
  auto* state = std::get_if<geometry::HeadState>(&read);
  if (state != nullptr) state->utime_us = repeated_stamp_.time_of(state->utime_us, arrived_us);
  std::string refusal =
      state != nullptr ? utime_check_.refusal(state->utime_us) : std::get<Refusal>(read).reason;
  if (!refusal.empty()) {
    refusals_.add(std::move(refusal));
    return false;
  }
  refusals_.accepted();
  newest_ = *state;
  waiting_.push(*state);
  return true;
}

std::optional<std::int64_t> HeadStateIntake::waiting_utime_us() const {
  if (waiting_.empty()) return std::nullopt;
  return waiting_.oldest().utime_us;
}

std::optional<geometry::HeadState> HeadStateIntake::next_state() {
  if (waiting_.empty()) return std::nullopt;
  return waiting_.take();
}

}  // namespace gazed::lcm
