#include "drivers/log/event_encoder.hpp"

#include <algorithm>
#include <utility>

#include "drivers/lcm/conversions.hpp"

namespace gazed::log {

Event EventEncoder::encode(const geometry::Frame& frame) {
  encoded_.resize(lcm::encoded_bytes(frame.image));
  lcm::encode_image(frame, encoded_);
  saw(frame.utime_us);
  return {.channel = channels_.image, .utime_us = frame.utime_us, .message = encoded_};
}

Event EventEncoder::encode(const geometry::HeadState& state) {
  lcm::to_message(state, state_message_);
  return encode_message(channels_.head_state, state_message_, state.utime_us);
}

Event EventEncoder::encode(const located_point_t& point) {
  return encode_message(channels_.located_point, point, std::max(newest_utime_us_, point.utime));
}

Event EventEncoder::encode(const fixation_t& fixation) {
  return encode_message(channels_.fixation, fixation, std::max(newest_utime_us_, fixation.utime));
}

template <class Message>
Event EventEncoder::encode_message(const std::string& channel, const Message& message,
                                   std::int64_t utime_us) {
  encoded_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(encoded_.data(), 0, static_cast<int>(encoded_.size()));
  newest_utime_us_ = utime_us;
  return {.channel = channel, .utime_us = utime_us, .message = encoded_};
}

}  // namespace gazed::log
